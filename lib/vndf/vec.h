// Vectors of the shading frame: x and y tangent, z along the macroscopic normal.
// wi is the unit incident direction, wm the unit microfacet normal; the slope of a normal is
// (-wm.x / wm.z, -wm.y / wm.z) (Heitz and d'Eon 2014, equation 6).
#pragma once

#include <cmath>
#include <limits>

namespace vndf {

template <class T>
struct Vec2 {
  T x, y;
};

template <class T>
struct Vec3 {
  T x, y, z;
};

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

/// Scales `v` to unit length; (0, 0, 1) where `v` is zero or not finite.
template <class T>
Vec3<T> normalize_or_up(const Vec3<T>& v) {
  const T square = dot(v, v);
  if (!(square > T(0) && square <= std::numeric_limits<T>::max())) return {T(0), T(0), T(1)};
  const T scale = T(1) / std::sqrt(square);
  return {v.x * scale, v.y * scale, v.z * scale};
}

/// Slope of the normal `m`. A horizontal normal has infinite slope along its non-zero components.
template <class T>
Vec2<T> slope_of(const Vec3<T>& m) {
  return {m.x == T(0) ? T(0) : -m.x / m.z, m.y == T(0) ? T(0) : -m.y / m.z};
}

}  // namespace vndf
