// One incident direction at one surface: every check is made at such a configuration. Directions,
// roughness and mean slopes are numbers of single precision that are then taken as exact. A sampler
// in single precision and the exact distribution in double precision are therefore given the same
// input, and no verdict depends on how a sampler rounds what it is given. The correlation is not
// rounded, because that of a narrow surface would become 1.
#pragma once

#include <cmath>
#include <limits>
#include <numbers>

#include "vndf/validate/exact/exact_surface.h"
#include "vndf/vec.h"

namespace vndf::validate {

/// One degree in radians.
inline constexpr double kDegree = std::numbers::pi / 180;
/// Stands for a number that is not known, and is not a number.
inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// The random numbers (u1, u2) in [0, 1] that a sampler turns into one normal.
using RandomPair = Vec2<double>;

/// A unit direction wi of either side of the horizon, and the numbers of a surface
/// (exact_surface.h).
struct Configuration {
  Vec3<double> wi;
  Alpha<double> alpha;
  double correlation = 0;
  Vec2<double> mean{0, 0};

  ExactSurface surface() const { return {alpha, correlation, mean}; }

  /// Angle between wi and the z axis, in degrees from 0 to 180.
  double theta() const { return std::atan2(std::hypot(wi.x, wi.y), wi.z) / kDegree; }

  /// The angle of (wi.x, wi.y, height()) from the vertical in degrees: theta() where there is no
  /// mean slope, and more than 90 below the surface.
  double incidence() const { return std::atan2(std::hypot(wi.x, wi.y), height()) / kDegree; }

  /// The area that the mean facet shows to wi: wi.z where there is no mean slope. Directions from
  /// which it is negative are below the surface.
  double height() const { return surface().height(wi); }
};

/// The number of single precision that is nearest to `v`.
inline double to_single(double v) {
  return static_cast<double>(static_cast<float>(v));
}

/// The configuration at incidence `theta` in [0, 180] and azimuth `phi`, both in degrees. At 90
/// degrees wi.z is exactly 0, so that the horizon itself is among the configurations.
inline Configuration at_angles(double theta, double phi, double alpha_x, double alpha_y,
                               double correlation = 0, const Vec2<double>& mean = {0, 0}) {
  const double sine = std::sin(theta * kDegree);
  const double cosine = theta == 90 ? 0 : std::cos(theta * kDegree);
  return {{to_single(sine * std::cos(phi * kDegree)), to_single(sine * std::sin(phi * kDegree)),
           to_single(cosine)},
          {to_single(alpha_x), to_single(alpha_y)},
          correlation,
          {to_single(mean.x), to_single(mean.y)}};
}

/// Where a result was measured. What does not apply, such as u1 of a count, is kUnknown.
struct Place {
  double theta = kUnknown;  ///< degrees
  double alpha_x = kUnknown, alpha_y = kUnknown;
  double u1 = kUnknown, u2 = kUnknown;
  double correlation = 0, mean_x = 0, mean_y = 0;
};

/// The place of a result at configuration `c`, and at random numbers where these apply.
inline Place place_of(const Configuration& c, double u1 = kUnknown, double u2 = kUnknown) {
  return {c.theta(), c.alpha.x, c.alpha.y, u1, u2, c.correlation, c.mean.x, c.mean.y};
}

}  // namespace vndf::validate
