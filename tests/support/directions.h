// Directions by their angles, and what is asked of a sampled normal.
#pragma once

#include <cmath>
#include <limits>
#include <numbers>

#include "vndf/vec.h"

namespace vndf::test {

inline constexpr double kDegree = std::numbers::pi / 180;

/// The direction at `degrees` from the pole and the azimuth `phi`, in degrees. At 90 degrees z is
/// exactly 0.
template <class T>
Vec3<T> direction_at(double degrees, double phi = 0) {
  const double theta = degrees * kDegree, turn = phi * kDegree;
  const double z = degrees == 90 ? 0 : std::cos(theta);
  return {static_cast<T>(std::sin(theta) * std::cos(turn)),
          static_cast<T>(std::sin(theta) * std::sin(turn)), static_cast<T>(z)};
}

/// Bit for bit, but for the sign of 0.
template <class T>
bool same(const Vec3<T>& a, const Vec3<T>& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z;
}

/// Of length 1 to the rounding of its components, and not below the horizon.
template <class T>
bool finite_unit(const Vec3<T>& m) {
  return std::isfinite(m.x) && std::isfinite(m.y) && std::isfinite(m.z) &&
         std::abs(dot(m, m) - 1) < 8 * std::numeric_limits<T>::epsilon() && m.z >= 0;
}

}  // namespace vndf::test
