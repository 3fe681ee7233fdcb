// Visible Beckmann slopes by the analytic method of Heitz and d'Eon 2014 (supplemental 1, Algorithm
// 2), for comparison. slope_x is drawn from one of three inverses in closed form: for
// x <= -cot(theta) by erf or by exp, and for |x| < cot(theta) by erf with a swap of its sign that
// uses up part of u2. slope_y is drawn by erf from the rest of u2. We keep and measure the defects
// of the published method and do not repair them.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "vndf/reference/beckmann.h"
#include "vndf/reference/erf_inverse.h"
#include "vndf/reference/random_reuse.h"
#include "vndf/reference/smith.h"

namespace vndf {

/// The Method (smith.h) of BeckmannAnalytic.
struct BeckmannAnalyticMethod {
  /// The method treats a cosine (at unit roughness) above this as normal incidence. There normals
  /// with slopes beyond cot(theta) >= 223 face away from wi, but only u1 = 1 gives one.
  static constexpr double kNormalIncidence = 0.99999;
  /// Largest |CDF - u| of both slopes. At the edge of that cone it is kConeError, which is
  /// tan(theta) M(0). Elsewhere it is rounding, in float and in double, and below kError, which is
  /// the resolution of the test.
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
    // x between -cot(theta) and cot(theta), which must be enforced where erf_a is rounded to 1
    const T v = renormalised(u1.u, c, T(1));
    const T x = std::clamp(erf_inverse((T(2) * v - T(1)) * erf_a), -a, a);
    const T p = T(0.5) - x * wi.sin / (T(2) * wi.cos);
    const bool swap = u2.u > p;
    const T rest = swap ? renormalised(u2.u, p, T(1)) : renormalised(u2.u, T(0), p);
    return homogeneous_slope(swap ? -x : x, erf_inverse(T(2) * rest - T(1)));
  }

  /// slope_x <= -cot(theta).
  template <class T>
  static T sample_below(const Incidence<T>& wi, T erf_a, T exp_a2, T edge_mass, T u) {
    const T w1 = wi.sin * edge_mass, w2 = wi.cos * (T(0.5) - T(0.5) * erf_a);
    const T p = w1 + w2 > T(0) ? w1 / (w1 + w2) : T(1);
    if (u <= p) return -std::sqrt(-std::log(renormalised(u, T(0), p) * exp_a2));
    const T v = renormalised(u, p, T(1));
    return erf_inverse(v - T(1) - v * erf_a);
  }
};

/// The map is not monotone: slope_x increases with u1 in each of three intervals, and u2 also
/// chooses its sign.
template <class T>
using BeckmannAnalytic = VisibleSampler<T, BeckmannShape, BeckmannAnalyticMethod>;

}  // namespace vndf
