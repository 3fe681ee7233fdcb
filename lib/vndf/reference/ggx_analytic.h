// Visible GGX slopes by the analytic method of Heitz and d'Eon 2014 (supplemental 1, Algorithm 3),
// for comparison. slope_x is the root of a quadratic in u1, and slope_y a rational fit in u2. We
// keep and measure the defects of the published method and do not repair them.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "vndf/reference/ggx.h"
#include "vndf/reference/smith.h"

namespace vndf {

/// The Method (smith.h) of GgxAnalytic.
struct GgxAnalyticMethod {
  /// The method treats a cosine (at unit roughness) above this as normal incidence. There normals
  /// with slopes beyond cot(theta) >= 223 face away from wi, which is one in 2e5 at the edge.
  static constexpr double kNormalIncidence = 0.99999;
  /// Largest |CDF - u| of slope_x. At the edge of that cone it is kConeError, which is
  /// tan(theta) M(0). Elsewhere it is below kError in double.
  static constexpr double kConeError = 2.24e-3, kError = 1e-10;
  /// In float the roots cancel where A is near 1 or -1, so that single u1 near G1 give slopes whose
  /// |CDF - u| is up to kFloatMapError. Such u1 are rare: no more than the fraction kFloatError of
  /// all pairs (u1, u2) have an error above kFloatError.
  static constexpr double kFloatMapError = 0.2, kFloatError = 1e-4;
  /// Largest |CDF - u| of the rational fit of slope_y. It occurs at u2 = 0 and 1, where the fit
  /// ends at |z| = |y| / sqrt(1 + x^2) = kFitEnd, so that the 1.1e-3 of the normals beyond are
  /// missing.
  static constexpr double kFitError = 5.5e-4, kFitEnd = 7.256;
  /// Largest tan(theta) that the quadratic is solved for, because it overflows beyond.
  static constexpr double kFarthestTangent = 1e10;

  template <class T>
  static HomogeneousSlope<T> sample_slope(const Incidence<T>& wi, const Probability<T>& u1,
                                          const Probability<T>& u2) {
    if (wi.cos >= static_cast<T>(kNormalIncidence)) return GgxShape::polar_slope(u1, u2.u);
    const T x = sample_x(wi, u1.u);
    return homogeneous_slope(x, sample_z(u2.u) * std::sqrt(T(1) + x * x));
  }

  /// The root x of (B + x) / sqrt(1 + x^2) = A, where A = 2 u1 / G1 - 1 and B = tan(theta).
  template <class T>
  static T sample_x(const Incidence<T>& wi, T u1) {
    constexpr T kJustBelowOne = T(1) - std::numeric_limits<T>::epsilon();
    const T b = std::min(wi.sin / wi.cos, static_cast<T>(kFarthestTangent));
    const T g1 = T(2) / (T(1) + std::sqrt(T(1) + b * b));
    T a = T(2) * u1 / g1 - T(1);
    if (a * a == T(1)) a *= kJustBelowOne;  // where the equation is linear
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

/// Outside the cone of kNormalIncidence slope_x increases with u1 and slope_y with u2 in the frame
/// of the stretched incident direction. Inside it u1 gives the length of the slope and u2 its
/// azimuth.
template <class T>
using GgxAnalytic = VisibleSampler<T, GgxShape, GgxAnalyticMethod>;

}  // namespace vndf
