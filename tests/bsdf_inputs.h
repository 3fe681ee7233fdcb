// Surfaces, directions and integrals for the tests of the BSDFs.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "exact_ggx.h"
#include "random_inputs.h"
#include "vndf/all_normals.h"
#include "vndf/normal_sampler.h"

namespace vndf::test {

/// The visible normals of V-cavities of GGX (Algorithm 3). The choice between a normal and its twin
/// is made by the lower 33 of the 53 bits of u1, which the choice of the cavity hardly needs.
class ExactVCavity {
  using T = double;

 public:
  static constexpr bool kVisible = true;

  Vec3<T> sample(const Vec3<T>& wi, const Alpha<T>& alpha, T u1, T u2) const noexcept {
    const T scaled = std::ldexp(u1, 20), choice = scaled - std::floor(scaled);
    const Vec3<T> m = normals_.sample(wi, alpha, u1, u2);
    const Vec3<T> twin{-m.x, -m.y, m.z};
    const T own = std::max(T(0), dot(wi, m)), other = std::max(T(0), dot(wi, twin));
    return choice * (own + other) < other ? twin : m;
  }
  T d(const Vec3<T>& m, const Alpha<T>& alpha) const noexcept { return normals_.d(m, alpha); }
  T lambda(const Vec3<T>& w, const Alpha<T>& alpha) const noexcept {
    return normals_.lambda(w, alpha);
  }
  T g1(const Vec3<T>& w, const Alpha<T>& alpha) const noexcept { return normals_.g1(w, alpha); }
  T pdf(const Vec3<T>& wi, const Vec3<T>& wm, const Alpha<T>& alpha) const noexcept {
    const T cosine = dot(wi, wm);
    if (!(cosine > 0)) return 0;
    return d(wm, alpha) * (wi.z > 0 ? std::min(cosine / wi.z, 2 * wm.z) : 2 * wm.z);
  }

 private:
  AllNormals<T, ExactGgx<T>> normals_{ExactGgx<T>{}};
};

inline constexpr double kDegree = std::numbers::pi / 180;

template <class T>
Vec3<T> direction(double degrees, double azimuth = 0) {
  const double theta = degrees * kDegree, phi = azimuth * kDegree;
  return {static_cast<T>(std::sin(theta) * std::cos(phi)),
          static_cast<T>(std::sin(theta) * std::sin(phi)), static_cast<T>(std::cos(theta))};
}

/// A direction uniform in theta and azimuth.
inline Vec3<double> random_direction(RandomInputs& random, double largest_degrees) {
  return direction<double>(largest_degrees * random.uniform(), 360 * random.uniform());
}

/// int f(w) dw over the upper hemisphere, by the midpoint rule in w.z and azimuth.
template <class F>
double over_hemisphere(F f, int rings = 600) {
  const int spokes = rings;
  double sum = 0;
  for (int i = 0; i < rings; ++i) {
    const double z = (i + 0.5) / rings, s = std::sqrt(1 - z * z);
    for (int j = 0; j < spokes; ++j) {
      const double phi = 2 * std::numbers::pi * (j + 0.5) / spokes;
      sum += f(Vec3<double>{s * std::cos(phi), s * std::sin(phi), z});
    }
  }
  return sum * 2 * std::numbers::pi / rings / spokes;
}

}  // namespace vndf::test
