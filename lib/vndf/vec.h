// Vectors of the shading frame: x and y tangent, z along the macroscopic normal.
// wi is the unit incident direction, wm the unit microfacet normal; the slope of a normal is
// (-wm.x / wm.z, -wm.y / wm.z) (Heitz and d'Eon 2014, equation 6).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

/// A member function that device code of CUDA calls too.
#ifdef __CUDACC__
#define VNDF_DEVICE __host__ __device__
#else
#define VNDF_DEVICE
#endif

namespace vndf {

template <class T>
struct Vec2 {
  T x, y;
};

template <class T>
struct Vec3 {
  T x, y, z;
};

/// Largest difference of the length of a normal from 1, which rounding leaves.
template <class T>
inline constexpr T kLengthSlack = T(4) * std::numeric_limits<T>::epsilon();

/// Largest -dot(wi, wm) that rounding can leave on a sampled normal, whose exact value is >= 0.
template <class T>
inline constexpr T kFacingSlack = T(4) * std::numeric_limits<T>::epsilon();

/// Roughness along x and y, in the units of the distribution's own definition. Valid: > 0.
template <class T>
struct Alpha {
  T x, y;
};

template <class T>
T dot(const Vec3<T>& a, const Vec3<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// A normal with the density per solid angle that it was drawn with.
template <class T>
struct SampledNormal {
  Vec3<T> wm;
  T pdf;
};

/// normalize_or_up() of a vector whose square has lost digits or left the range of T: it is scaled
/// up or down first. It stands apart because it is seldom needed.
template <class T>
[[gnu::noinline, gnu::cold]] Vec3<T> normalize_unusual(const Vec3<T>& v) {
  const T size = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  const Vec3<T> scaled{v.x / size, v.y / size, v.z / size};
  const T square = dot(scaled, scaled);
  if (!(square >= T(1))) return {T(0), T(0), T(1)};
  const T scale = T(1) / std::sqrt(square);
  return {scaled.x * scale, scaled.y * scale, scaled.z * scale};
}

/// Scales `v`, of any length, to unit length; (0, 0, 1) where `v` is zero or not finite. Maximum
/// error of the length: kLengthSlack<T>.
template <class T>
Vec3<T> normalize_or_up(const Vec3<T>& v) {
  // The squares of components that matter are then above the least number that has all its digits.
  constexpr T kLeast = std::numeric_limits<T>::min() / std::numeric_limits<T>::epsilon();
  const T square = dot(v, v);
  if (!(square >= kLeast && square <= std::numeric_limits<T>::max())) return normalize_unusual(v);
  const T scale = T(1) / std::sqrt(square);
  return {v.x * scale, v.y * scale, v.z * scale};
}

/// Slope of the normal `m`. A horizontal normal has infinite slope along its non-zero components.
template <class T>
Vec2<T> slope_of(const Vec3<T>& m) {
  return {m.x == T(0) ? T(0) : -m.x / m.z, m.y == T(0) ? T(0) : -m.y / m.z};
}

}  // namespace vndf
