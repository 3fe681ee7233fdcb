// Visible GGX slopes by the analytic method of Heitz and d'Eon 2014, supplemental 1, Algorithm 3:
// slope_x from u1 by the root of a quadratic, slope_y from u2 by a rational fit. Defects of the
// method are kept and measured, not mended.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "vndf/reference/ggx.h"
#include "vndf/reference/smith.h"

namespace vndf {

struct GgxAnalyticMethod {
  /// The method takes a cosine (at unit roughness) above this for normal incidence. There normals
  /// with slopes beyond cot(theta) >= 223 face away from wi, one in 2e5 at the edge.
  static constexpr double kNormalIncidence = 0.99999;
  /// Largest distance of the sampled law of slope_x from the exact one, |CDF - u|: at the edge of
  /// that cone it is tan(theta) M(0). Elsewhere, in double, it is below kError.
  static constexpr double kConeError = 2.24e-3, kError = 1e-10;
  /// In float the roots cancel where A is near 1 or -1: single u1 near G1 give slopes off by up to
  /// kFloatMapError. They are rare: no more than kFloatError of all pairs (u1, u2) are off by more
  /// than kFloatError.
  static constexpr double kFloatMapError = 0.2, kFloatError = 1e-4;
  /// Largest |CDF - u| of the rational fit of slope_y, at u2 = 0 and 1, where it ends at
  /// |z| = |y| / sqrt(1 + x^2) = kFitEnd: the 1.1e-3 of the normals beyond are missing.
  static constexpr double kFitError = 5.5e-4, kFitEnd = 7.256;
  /// Slopes are taken as visible up to this tangent of theta: beyond, the quadratic overflows.
  static constexpr double kFarthestTangent = 1e10;

  template <class T>
  static HomogeneousSlope<T> sample_slope(const Incidence<T>& wi, const Probability<T>& u1,
                                          const Probability<T>& u2) {
    if (wi.cos >= static_cast<T>(kNormalIncidence)) return GgxShape::polar_slope(u1, u2.u);
    const T x = sample_x(wi, u1.u);
    return homogeneous_slope(x, sample_z(u2.u) * std::sqrt(T(1) + x * x));
  }

  /// Root of (B + x) / sqrt(1 + x^2) = A, A = 2 u1 / G1 - 1 and B = tan(theta).
  template <class T>
  static T sample_x(const Incidence<T>& wi, T u1) {
    constexpr T kJustBelowOne = T(1) - std::numeric_limits<T>::epsilon();
    const T b = std::min(wi.sin / wi.cos, static_cast<T>(kFarthestTangent));
    const T g1 = T(2) / (T(1) + std::sqrt(T(1) + b * b));
    T a = T(2) * u1 / g1 - T(1);
    if (a * a == T(1)) a *= kJustBelowOne;  // where the quadratic is none
    const T scale = T(1) / (a * a - T(1));
    const T middle = b * scale;
    const T half = std::sqrt(std::max(T(0), middle * middle - (a * a - b * b) * scale));
    const T x = a < T(0) || middle + half > T(1) / b ? middle - half : middle + half;
    return std::min(x, T(1) / b);
  }

  /// The fit of the inverse of P(Z <= z) = 1/2 + (atan(z) + z / (1 + z^2)) / pi.
  template <class T>
  static T sample_z(T u2) {
    const T u = std::abs(T(2) * u2 - T(1));
    const T numerator = u * (T(0.46341) + u * (T(-0.73369) + u * T(0.27385)));
    const T denominator = T(0.597999) + u * (T(-1) + u * (T(0.309420) + u * T(0.093073)));
    return std::copysign(numerator / denominator, u2 - T(0.5));
  }
};

/// Outside the cone slope_x increases with u1, and slope_y with u2, in the frame of the stretched
/// incident direction; within it u1 gives the length of the slope and u2 its azimuth.
template <class T>
using GgxAnalytic = VisibleSampler<T, GgxShape, GgxAnalyticMethod>;

}  // namespace vndf
