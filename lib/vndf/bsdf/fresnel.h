// Fresnel's reflectance of a smooth facet for unpolarised light, which is F(wi, wm) of Heitz and
// d'Eon 2014, as a function of cosine = wi.wm in [0, 1]. The textbook quotients lose digits near
// eta = 1 and at grazing incidence. We therefore use, with c = cosine and g = eta wo.wm,
//
//   r_s = (c - g) / (c + g),    r_p = r_s (c g - s^2) / (c g + s^2),    s^2 = 1 - c^2,
//
// and c - g = (1 - eta^2) / (c + g), which is equation 22 of Walter et al. 2007 rearranged. Nothing
// cancels in it except at Brewster's angle, where r_p is 0.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "vndf/bsdf/scatter.h"

namespace vndf {

/// Largest absolute error of both reflectances for indices in [0.1, 10]. That of
/// fresnel_dielectric() grows to kFresnelError / g where g < 1, but to no more than
/// kFresnelErrorAtCriticalAngle.
template <class T>
inline constexpr T kFresnelError = T(64) * std::numeric_limits<T>::epsilon();
/// Largest absolute error of fresnel_dielectric() near the critical angle, 4 sqrt(epsilon): there
/// the reflectance has a vertical tangent.
template <class T>
inline constexpr T kFresnelErrorAtCriticalAngle = std::numeric_limits<T>::digits == 24 ? T(1.4e-3)
                                                                                       : T(6e-8);

/// Reflectance of a dielectric with eta = n_o / n_i > 0, which is above 1 for light from outside
/// and below 1 for light from inside. It is 1 at total internal reflection and 0 at eta = 1.
/// Maximum error: kFresnelError.
template <class T>
T fresnel_dielectric(T cosine, T eta) noexcept {
  const T square = squared_far_cosine(cosine, eta);
  if (square < T(0)) return T(1);
  if (eta == T(1)) return T(0);
  const T g = std::sqrt(square), sum = cosine + g;
  const T root_s = (T(1) - eta) * (T(1) + eta) / (sum * sum);
  const T cg = cosine * g, sine_square = (T(1) - cosine) * (T(1) + cosine);
  const T ratio = (cg - sine_square) / (cg + sine_square);
  return std::min(T(1), T(0.5) * root_s * root_s * (T(1) + ratio * ratio));
}

/// Complex refractive index eta + i k of a metal, divided by the index of the medium that wi is in.
/// Valid: eta > 0, k >= 0.
template <class T>
struct ComplexIndex {
  T eta, k;
};

/// Reflectance of a conductor; at k = 0 it is that of a dielectric. Maximum error: kFresnelError.
template <class T>
T fresnel_conductor(T cosine, const ComplexIndex<T>& index) noexcept {
  // a + i b = sqrt((eta + i k)^2 - s^2) takes the place of g. The larger of a and b comes from the
  // root and the other from a b = eta k, so that neither cancels.
  const T sine_square = (T(1) - cosine) * (T(1) + cosine);
  const T real = squared_far_cosine(cosine, index.eta) - index.k * index.k;
  const T half_imaginary = index.eta * index.k;
  const T larger = std::sqrt(T(0.5) * (std::abs(real) + std::hypot(real, T(2) * half_imaginary)));
  const T smaller = larger > T(0) ? half_imaginary / larger : T(0);
  const T a = real > T(0) ? larger : smaller, b = real > T(0) ? smaller : larger;
  const auto square = [](T x, T y) { return x * x + y * y; };
  const T norm_s = square(cosine + a, b);
  if (!(norm_s > T(0))) return T(0);  // index 1 at grazing
  const T ca = cosine * a, cb = cosine * b;
  const T ratio = square(ca - sine_square, cb) / square(ca + sine_square, cb);
  return std::min(T(1), T(0.5) * square(cosine - a, b) / norm_s * (T(1) + ratio));
}

/// Reflectance of a metal in N channels of colour, for example of gold in red, green and blue:
///
///     const vndf::ConductorFresnel gold{{0.14f, 0.37f, 1.44f}, {4.1f, 2.3f, 1.8f}};
template <class T, std::size_t N>
struct ConductorFresnel {
  std::array<T, N> eta, k;  ///< The complex refractive index eta + i k of each channel.

  /// fresnel_conductor() at `cosine` for each channel.
  std::array<T, N> operator()(T cosine) const noexcept {
    std::array<T, N> f;
    for (std::size_t i = 0; i < N; ++i) f[i] = fresnel_conductor(cosine, {eta[i], k[i]});
    return f;
  }
};

template <class T, std::size_t N>
ConductorFresnel(const T (&eta)[N], const T (&k)[N]) -> ConductorFresnel<T, N>;

/// A metal that reflects everything, so that only masking and shadowing are left (for white furnace
/// tests).
template <class T>
struct PerfectMirror {
  std::array<T, 1> operator()(T) const noexcept { return {T(1)}; }
};

}  // namespace vndf
