// One incident direction at one roughness: every check is made at such a configuration. Directions
// and roughness are numbers of single precision that are then taken as exact. A sampler in single
// precision and the exact distribution in double precision are therefore given the same input, and
// no verdict depends on how a sampler rounds what it is given.
#pragma once

#include <cmath>
#include <limits>
#include <numbers>

#include "vndf/vec.h"

namespace vndf::validate {

/// One degree in radians.
inline constexpr double kDegree = std::numbers::pi / 180;
/// Stands for a number that is not known, and is not a number.
inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// The random numbers (u1, u2) in [0, 1] that a sampler turns into one normal.
using RandomPair = Vec2<double>;

/// A unit direction wi and a roughness > 0 along x and y. Checks of samplers are made at wi.z >= 0.
struct Configuration {
  Vec3<double> wi;
  Alpha<double> alpha;

  /// Angle between wi and the normal of the surface, in degrees from 0 to 180.
  double theta() const { return std::atan2(std::hypot(wi.x, wi.y), wi.z) / kDegree; }

  bool operator==(const Configuration& o) const {
    return wi.x == o.wi.x && wi.y == o.wi.y && wi.z == o.wi.z && alpha.x == o.alpha.x &&
           alpha.y == o.alpha.y;
  }
};

/// The number of single precision that is nearest to `v`.
inline double to_single(double v) {
  return static_cast<double>(static_cast<float>(v));
}

/// The configuration at incidence `theta` in [0, 180] and azimuth `phi`, both in degrees. At 90
/// degrees wi.z is exactly 0, so that the horizon itself is among the configurations.
inline Configuration at_angles(double theta, double phi, double alpha_x, double alpha_y) {
  const double sine = std::sin(theta * kDegree);
  const double cosine = theta == 90 ? 0 : std::cos(theta * kDegree);
  return {{to_single(sine * std::cos(phi * kDegree)), to_single(sine * std::sin(phi * kDegree)),
           to_single(cosine)},
          {to_single(alpha_x), to_single(alpha_y)}};
}

/// Where a result was measured. What does not apply, such as u1 of a count, is kUnknown.
struct Place {
  double theta = kUnknown;  ///< degrees
  double alpha_x = kUnknown, alpha_y = kUnknown;
  double u1 = kUnknown, u2 = kUnknown;
};

/// The place of a result at configuration `c`, and at random numbers where these apply.
inline Place place_of(const Configuration& c, double u1 = kUnknown, double u2 = kUnknown) {
  return {c.theta(), c.alpha.x, c.alpha.y, u1, u2};
}

}  // namespace vndf::validate
