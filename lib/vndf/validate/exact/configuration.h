// One incident direction at one roughness: what every check is made at. Directions and
// roughness are whole single-precision numbers, then taken as exact, so that no check depends
// on how a sampler rounds its inputs.
#pragma once

#include <cmath>
#include <limits>
#include <numbers>

#include "vndf/vec.h"

namespace vndf::validate {

inline constexpr double kDegree = std::numbers::pi / 180;
inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// Two random numbers in [0, 1], u1 and u2: what a sampler turns into one normal.
using RandomPair = Vec2<double>;

struct Configuration {
  Vec3<double> wi;
  Alpha<double> alpha;

  /// Angle of wi from the normal, degrees in [0, 90].
  double theta() const { return std::atan2(std::hypot(wi.x, wi.y), wi.z) / kDegree; }

  bool operator==(const Configuration& o) const {
    return wi.x == o.wi.x && wi.y == o.wi.y && wi.z == o.wi.z && alpha.x == o.alpha.x &&
           alpha.y == o.alpha.y;
  }
};

inline double to_single(double v) {
  return static_cast<double>(static_cast<float>(v));
}

/// Incidence `theta` in [0, 90] and azimuth `phi`, in degrees. At 90 degrees wi.z is exactly 0.
inline Configuration at_angles(double theta, double phi, double alpha_x, double alpha_y) {
  const double sine = std::sin(theta * kDegree);
  const double cosine = theta == 90 ? 0 : std::cos(theta * kDegree);
  return {{to_single(sine * std::cos(phi * kDegree)), to_single(sine * std::sin(phi * kDegree)),
           to_single(cosine)},
          {to_single(alpha_x), to_single(alpha_y)}};
}

/// Where a result is; what does not apply is not a number.
struct Place {
  double theta = kUnknown;  ///< degrees
  double alpha_x = kUnknown, alpha_y = kUnknown;
  double u1 = kUnknown, u2 = kUnknown;
};

inline Place place_of(const Configuration& c, double u1 = kUnknown, double u2 = kUnknown) {
  return {c.theta(), c.alpha.x, c.alpha.y, u1, u2};
}

}  // namespace vndf::validate
