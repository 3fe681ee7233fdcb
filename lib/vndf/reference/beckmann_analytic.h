// Visible Beckmann slopes by the analytic method of Heitz and d'Eon 2014, supplemental 1, Algorithm
// 2. slope_x is drawn from one of three closed inverses, on x <= -cot(theta) by erf or by exp, on
// |x| < cot(theta) by erf, the last with a swap of sign that spends u2; slope_y by erf from what is
// left of u2. Defects of the method are kept and measured, not mended.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "vndf/reference/beckmann.h"
#include "vndf/reference/erf_inverse.h"
#include "vndf/reference/random_reuse.h"
#include "vndf/reference/smith.h"

namespace vndf {

struct BeckmannAnalyticMethod {
  /// The method takes a cosine (at unit roughness) above this for normal incidence. There normals
  /// with slopes beyond cot(theta) >= 223 face away from wi; no number but u1 = 1 gives one.
  static constexpr double kNormalIncidence = 0.99999;
  /// Largest distance of the sampled law from the exact one, |CDF - u| of both slopes: at the edge
  /// of that cone it is tan(theta) M(0); elsewhere, in float and in double, it is rounding, below
  /// kError, which is what the test resolves.
  static constexpr double kConeError = 1.26e-3, kError = 2e-5;

  template <class T>
  static HomogeneousSlope<T> sample_slope(const Incidence<T>& wi, const Probability<T>& u1,
                                          const Probability<T>& u2) {
    if (wi.cos >= static_cast<T>(kNormalIncidence)) return BeckmannShape::polar_slope(u1, u2.u);
    const T a = wi.cos / wi.sin;
    const T erf_a = std::erf(a), exp_a2 = std::exp(-a * a);
    const T edge_mass = T(0.5) * std::numbers::inv_sqrtpi_v<T> * exp_a2;
    // G1 = a / (a + a Lambda), a number at the horizon too; C = 1 - G1 erf(a)
    const T g1 = a / (a + T(0.5) * a * (erf_a - T(1)) + edge_mass);
    const T c = std::clamp(T(1) - g1 * erf_a, T(0), T(1));
    if (u1.u <= c) {
      const T x = sample_below(wi, erf_a, exp_a2, edge_mass, renormalised(u1.u, T(0), c));
      return homogeneous_slope(x, erf_inverse(T(2) * u2.u - T(1)));
    }
    // x between -cot(theta) and cot(theta); erf_a rounded to 1 leaves them no other bound
    const T v = renormalised(u1.u, c, T(1));
    const T x = std::clamp(erf_inverse((T(2) * v - T(1)) * erf_a), -a, a);
    const T p = T(0.5) - x * wi.sin / (T(2) * wi.cos);
    const bool swap = u2.u > p;
    const T rest = swap ? renormalised(u2.u, p, T(1)) : renormalised(u2.u, T(0), p);
    return homogeneous_slope(swap ? -x : x, erf_inverse(T(2) * rest - T(1)));
  }

  /// x <= -cot(theta).
  template <class T>
  static T sample_below(const Incidence<T>& wi, T erf_a, T exp_a2, T edge_mass, T u) {
    const T w1 = wi.sin * edge_mass, w2 = wi.cos * (T(0.5) - T(0.5) * erf_a);
    const T p = w1 + w2 > T(0) ? w1 / (w1 + w2) : T(1);
    if (u <= p) return -std::sqrt(-std::log(renormalised(u, T(0), p) * exp_a2));
    const T v = renormalised(u, p, T(1));
    return erf_inverse(v - T(1) - v * erf_a);
  }
};

/// Not monotone: slope_x rises with u1 in each of three intervals, and u2 chooses its sign too.
template <class T>
using BeckmannAnalytic = VisibleSampler<T, BeckmannShape, BeckmannAnalyticMethod>;

}  // namespace vndf
