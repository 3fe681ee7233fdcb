// The steps around every sampler of a shape-invariant distribution (Heitz and d'Eon 2014,
// Algorithm 4): the incident direction is stretched by alpha to unit roughness (step 1); the slope
// sampled there is rotated to its azimuth, unstretched and turned into a normal (steps 3 to 5).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "vndf/select.h"
#include "vndf/vec.h"

namespace vndf {

/// Smallest dot(wi, wm) that rounding can leave on a sampled normal, whose exact value is >= 0.
template <class T>
inline constexpr T kFacingSlack = T(4) * std::numeric_limits<T>::epsilon();

/// A slope in the frame of the stretched incident direction, (x / w, y / w), w >= 0.
template <class T>
struct HomogeneousSlope {
  T x, y, w;
};

/// The slope (x, y), of which one or both may be infinite.
template <class T>
HomogeneousSlope<T> homogeneous_slope(T x, T y) {
  if (std::isinf(x) || std::isinf(y)) {
    const auto at_infinity = [](T v) { return std::isinf(v) ? std::copysign(T(1), v) : T(0); };
    return {at_infinity(x), at_infinity(y), T(0)};
  }
  const T scale = std::max({T(1), std::abs(x), std::abs(y)});
  return {x / scale, y / scale, T(1) / scale};
}

/// Whether `w` is a direction on or above the horizon and `alpha` a roughness.
template <class T>
bool valid(const Vec3<T>& w, const Alpha<T>& alpha) {
  // What is infinite or no number makes the sum so.
  const T sum = std::abs(w.x) + std::abs(w.y) + alpha.x + alpha.y;
  return w.z >= T(0) && alpha.x > T(0) && alpha.y > T(0) && sum <= std::numeric_limits<T>::max();
}

/// Azimuth and length of a horizontal vector.
template <class T>
struct Azimuth {
  T cos, sin, length;
};

/// The azimuth of a vector too short to square, which is scaled up first: the map of a sampler is
/// continuous along every azimuth up to the pole. Only the zero vector has none, and 0 stands for
/// it. Apart, so that azimuth() is short where it is inlined.
template <class T>
[[gnu::noinline, gnu::cold]] Azimuth<T> azimuth_near_pole(T x, T y) {
  constexpr T kScale = T(1e18);
  if (x == T(0) && y == T(0)) return {T(1), T(0), T(0)};
  const T length = std::hypot(x * kScale, y * kScale);
  return {x * kScale / length, y * kScale / length, length / kScale};
}

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
