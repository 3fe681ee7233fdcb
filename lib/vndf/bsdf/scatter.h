// How a microfacet scatters light: the operators reflect and transmit of Heitz and d'Eon 2014
// (section 2.2), their half vectors and their Jacobians. wi and wo both point away from the
// surface. eta = n_o / n_i is the refractive index beyond the facet over that on the side of wi. It
// is 1 / n of the paper, whose printed root lacks the square of n.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "vndf/vec.h"

namespace vndf {

/// Largest absolute error of a component of reflect() for unit vectors.
template <class T>
inline constexpr T kReflectError = T(4) * std::numeric_limits<T>::epsilon();

/// Largest absolute error of eta times a component of refract() for eta in [0.1, 10]. It grows to
/// kRefractError / g where g = eta |wo.wm| < 1, but to no more than kRefractErrorAtCriticalAngle.
template <class T>
inline constexpr T kRefractError = T(24) * std::numeric_limits<T>::epsilon();
/// Largest absolute error of eta times a component of refract() near the critical angle,
/// 2 sqrt(epsilon).
template <class T>
inline constexpr T kRefractErrorAtCriticalAngle = std::numeric_limits<T>::digits == 24 ? T(7e-4)
                                                                                       : T(3e-8);

/// The direction into which a mirror with the unit normal `wm` sends `wi`. The sign of wm does not
/// matter. Maximum error: kReflectError.
template <class T>
Vec3<T> reflect(const Vec3<T>& wi, const Vec3<T>& wm) noexcept {
  const T scale = T(2) * dot(wi, wm);
  return {scale * wm.x - wi.x, scale * wm.y - wi.y, scale * wm.z - wi.z};
}

/// (eta wo.wm)^2 = eta^2 - 1 + cosine^2 by Snell's law, where cosine = wi.wm. It is negative at
/// total internal reflection.
template <class T>
T squared_far_cosine(T cosine, T eta) noexcept {
  // In factors eta^2 - 1 keeps its digits near eta = 1.
  return (eta - T(1)) * (eta + T(1)) + cosine * cosine;
}

/// The direction into which the facet `wm` refracts `wi`; nothing at total internal reflection. The
/// sign of wm does not matter. At eta = 1 the result is exactly -wi. Valid: eta > 0. Maximum error:
/// kRefractError.
template <class T>
std::optional<Vec3<T>> refract(const Vec3<T>& wi, const Vec3<T>& wm, T eta) noexcept {
  const T cosine = dot(wi, wm);
  const T square = squared_far_cosine(cosine, eta);
  if (!(square >= T(0))) return std::nullopt;
  // eta wo = (c - sign(c) g) wm - wi, g = eta |wo.wm|; c - g = (1 - eta^2) / (c + g), which does
  // not cancel near eta = 1.
  const T sum = std::abs(cosine) + std::sqrt(square);
  const T size = sum > T(0) ? (T(1) - eta) * (T(1) + eta) / sum : T(0);
  const T along = cosine < T(0) ? -size : size;
  return Vec3<T>{(along * wm.x - wi.x) / eta, (along * wm.y - wi.y) / eta,
                 (along * wm.z - wi.z) / eta};
}

/// The unit normal with wm.z >= 0 that reflects wi to wo, both above the surface (or both below).
template <class T>
Vec3<T> reflection_half_vector(const Vec3<T>& wi, const Vec3<T>& wo) noexcept {
  const T up = std::copysign(T(1), wi.z + wo.z);
  return normalize_or_up(Vec3<T>{up * (wi.x + wo.x), up * (wi.y + wo.y), up * (wi.z + wo.z)});
}

/// The unit normal with wm.z >= 0 that refracts wi to wo, on opposite sides of the surface. Such a
/// facet exists only if wi.wm and wo.wm have opposite signs, which the caller must check, and never
/// at eta = 1.
template <class T>
Vec3<T> transmission_half_vector(const Vec3<T>& wi, const Vec3<T>& wo, T eta) noexcept {
  const Vec3<T> h{wi.x + eta * wo.x, wi.y + eta * wo.y, wi.z + eta * wo.z};
  const T up = std::copysign(T(1), h.z);
  return normalize_or_up(Vec3<T>{up * h.x, up * h.y, up * h.z});
}

/// |d wo / d wm| of reflection at fixed wi, for the cosine wi.wm. Its inverse is the paper's
/// |d wm / d wo| = 1 / (4 |wi.wm|). A density of normals divided by it is one of directions.
template <class T>
T reflection_jacobian(T cosine) noexcept {
  return T(4) * std::abs(cosine);
}

/// |d wo / d wm| of refraction at fixed wi, for the cosines wi.wm and wo.wm of opposite signs. Its
/// inverse is the paper's |d wm / d wo| = eta^2 |wo.wm| / (wi.wm + eta wo.wm)^2. At fixed wo,
/// |d wi / d wm| is the same function with the cosines exchanged and 1 / eta. It is infinite at the
/// critical angle and 0 at eta = 1, where every facet refracts wi to -wi.
template <class T>
T refraction_jacobian(T cosine_i, T cosine_o, T eta) noexcept {
  const T sum = cosine_i / eta + cosine_o;
  return sum * sum / std::abs(cosine_o);
}

/// Density of outgoing directions for a density of normals; 0 where the map between them has no
/// inverse, and the largest number of T where it is beyond that, as for normals that are drawn
/// unseen and face a horizontal direction under a cosine of 1e-35.
template <class T>
T outgoing_density(T normal_density, T jacobian) noexcept {
  if (!(normal_density > T(0) && jacobian > T(0))) return T(0);
  return std::min(normal_density / jacobian, std::numeric_limits<T>::max());
}

}  // namespace vndf
