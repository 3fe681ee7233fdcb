// The steps of Algorithm 4 (Heitz and d'Eon 2014) that are the same for every shape-invariant
// distribution, because roughness only stretches it. Step 1 stretches the incident direction by
// alpha to unit roughness; the slope that is sampled there is rotated to the azimuth of the
// direction (3), unstretched (4) and turned into a normal (5).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "vndf/select.h"
#include "vndf/vec.h"

namespace vndf {

/// The slope (x / w, y / w), w >= 0, in the frame of the stretched incident direction. It has no
/// division, and so does not overflow where slopes are infinite.
template <class T>
struct HomogeneousSlope {
  T x, y, w;
};

/// The homogeneous form of (x, y), one or both of which may be infinite.
template <class T>
HomogeneousSlope<T> homogeneous_slope(T x, T y) {
  if (std::isinf(x) || std::isinf(y)) {
    const auto at_infinity = [](T v) { return std::isinf(v) ? std::copysign(T(1), v) : T(0); };
    return {at_infinity(x), at_infinity(y), T(0)};
  }
  const T scale = std::max({T(1), std::abs(x), std::abs(y)});
  return {x / scale, y / scale, T(1) / scale};
}

/// Whether `w` is a direction, above the horizon or below it, and `alpha` a roughness.
template <class T>
bool valid_anywhere(const Vec3<T>& w, const Alpha<T>& alpha) {
  // The sum is infinite or not a number if any of its terms is.
  const T sum = std::abs(w.x) + std::abs(w.y) + alpha.x + alpha.y;
  return w.z == w.z && alpha.x > T(0) && alpha.y > T(0) && sum <= std::numeric_limits<T>::max();
}

/// Whether `w` is a direction on or above the horizon and `alpha` a roughness.
template <class T>
bool valid(const Vec3<T>& w, const Alpha<T>& alpha) {
  return w.z >= T(0) && valid_anywhere(w, alpha);
}

/// Azimuth and length of a horizontal vector.
template <class T>
struct Azimuth {
  T cos, sin, length;
};

/// The azimuth of a vector too short to square, which is scaled up first, because the map of a
/// sampler is continuous along every azimuth up to the pole. Only the zero vector has none, and 0
/// stands for it. The function stands apart so that azimuth() is short where it is inlined.
template <class T>
[[gnu::noinline, gnu::cold]] Azimuth<T> azimuth_near_pole(T x, T y) {
  constexpr T kScale = T(1e18);
  if (x == T(0) && y == T(0)) return {T(1), T(0), T(0)};
  const T length = std::hypot(x * kScale, y * kScale);
  return {x * kScale / length, y * kScale / length, length / kScale};
}

/// Step 1: azimuth and length of the horizontal part of a stretched direction.
template <class T>
Azimuth<T> azimuth(T x, T y) {
  constexpr T kTooShort = T(1e-30);
  const T square = x * x + y * y;
  if (square < kTooShort) return azimuth_near_pole(x, y);
  const T length = std::sqrt(square), scale = T(1) / length;
  return {x * scale, y * scale, length};
}

/// Steps 3 and 4: the normal whose stretched slope, in the frame of azimuth `phi`, is `slope`, of
/// any length.
template <class T>
Vec3<T> unstretched(const HomogeneousSlope<T>& slope, const Azimuth<T>& phi,
                    const Alpha<T>& alpha) {
  // 3. rotate
  const T x = phi.cos * slope.x - phi.sin * slope.y;
  const T y = phi.sin * slope.x + phi.cos * slope.y;
  // 4. unstretch
  return {-alpha.x * x, -alpha.y * y, slope.w};
}

/// Inverse of unstretched(): the stretched slope, in the frame of azimuth `phi`, of the normal `m`.
template <class T>
HomogeneousSlope<T> stretched(const Vec3<T>& m, const Azimuth<T>& phi, const Alpha<T>& alpha) {
  const T x = -m.x / alpha.x, y = -m.y / alpha.y;
  return {phi.cos * x + phi.sin * y, phi.cos * y - phi.sin * x, m.z};
}

/// Steps 3 to 5: the unit normal; (0, 0, 1) where the slope is no number.
template <class T>
Vec3<T> unstretched_normal(const HomogeneousSlope<T>& slope, const Azimuth<T>& phi,
                           const Alpha<T>& alpha) {
  // 5. compute the normal
  return normalize_or_up(unstretched(slope, phi, alpha));
}

}  // namespace vndf
