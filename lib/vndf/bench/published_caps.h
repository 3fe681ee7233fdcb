// The unit of all times of the benchmark: visible GGX normals by spherical caps exactly as
// published (Dupuy and Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps"). The
// sampler of vndf/reference/ggx_caps.h is the same map, but it also treats the pole, the horizon
// and the ends of u, and therefore costs more.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "vndf/vec.h"

namespace vndf::bench {

/// Samples visible GGX normals.
struct PublishedCaps {
  /// In float no more than this fraction of all pairs (u1, u2) give slopes whose |CDF - u| is above
  /// it, for theta from 0 to 89.9 degrees.
  static constexpr double kFloatError = 7e-5;

  /// Draws a normal visible from `wi`, a unit vector with wi.z > 0, for u in [0, 1). The result for
  /// any other input is undefined.
  template <class T>
  Vec3<T> sample(const Vec3<T>& wi, const Alpha<T>& alpha, T u1, T u2) const noexcept {
    // 1. stretch
    const Vec3<T> w = unit(Vec3<T>{alpha.x * wi.x, alpha.y * wi.y, wi.z});
    // 2. a point of the spherical cap c.z > -w.z
    const T phi = T(2) * std::numbers::pi_v<T> * u1;
    const T z = (T(1) - u2) * (T(1) + w.z) - w.z;
    const T horizontal = std::sqrt(std::clamp(T(1) - z * z, T(0), T(1)));
    const T x = horizontal * std::cos(phi), y = horizontal * std::sin(phi);
    // 3. the half vector, 4. unstretch and normalise
    return unit(Vec3<T>{alpha.x * (x + w.x), alpha.y * (y + w.y), z + w.z});
  }

 private:
  template <class T>
  static Vec3<T> unit(const Vec3<T>& v) {
    const T scale = T(1) / std::sqrt(dot(v, v));
    return {v.x * scale, v.y * scale, v.z * scale};
  }
};

}  // namespace vndf::bench
