// GGX without tables: a sampler of visible normals that shares nothing with the tabulated one.
// Source: spherical caps, Dupuy and Benyoub 2023; Walter et al. 2007 for D and Lambda.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "vndf/vec.h"

namespace vndf::test {

template <class T>
class ExactGgx {
 public:
  using Scalar = T;
  static constexpr bool kVisible = true;

  Vec3<T> sample(const Vec3<T>& wi, const Alpha<T>& alpha, T u1, T u2) const noexcept {
    const Vec3<T> w = normalize_or_up(Vec3<T>{alpha.x * wi.x, alpha.y * wi.y, wi.z});
    const T phi = 2 * std::numbers::pi_v<T> * u1;
    const T z = (1 - u2) * (1 + w.z) - w.z;
    const T s = std::sqrt(std::clamp(1 - z * z, T(0), T(1)));
    return normalize_or_up(Vec3<T>{alpha.x * (s * std::cos(phi) + w.x),
                                   alpha.y * (s * std::sin(phi) + w.y), std::max(z + w.z, T(0))});
  }
  T d(const Vec3<T>& m, const Alpha<T>& alpha) const noexcept {
    if (!(m.z > 0)) return 0;
    const T x = m.x / alpha.x, y = m.y / alpha.y, square = x * x + y * y + m.z * m.z;
    return 1 / (std::numbers::pi_v<T> * alpha.x * alpha.y * square * square);
  }
  T lambda(const Vec3<T>& w, const Alpha<T>& alpha) const noexcept {
    const T z = std::abs(w.z), length = std::hypot(alpha.x * w.x, alpha.y * w.y);
    return (std::hypot(length, z) / z - 1) / 2;
  }
  T g1(const Vec3<T>& w, const Alpha<T>& alpha) const noexcept {
    const T z = std::abs(w.z), length = std::hypot(alpha.x * w.x, alpha.y * w.y);
    return 2 * z / (z + std::hypot(length, z));
  }
  T pdf(const Vec3<T>& wi, const Vec3<T>& wm, const Alpha<T>& alpha) const noexcept {
    const T cosine = dot(wi, wm);
    if (!(cosine > 0)) return 0;
    const T length = std::hypot(alpha.x * wi.x, alpha.y * wi.y);
    return 2 * cosine * d(wm, alpha) / (wi.z + std::hypot(length, wi.z));
  }
};

}  // namespace vndf::test
