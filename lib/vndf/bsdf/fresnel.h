// Fresnel's reflectance of a smooth facet for unpolarised light, F(wi, wm) of Heitz and d'Eon 2014,
// as a function of cosine = wi.wm in [0, 1]. Both kinds are written so that nothing cancels but the
// zero of Brewster's angle: with g = eta wo.wm,
//
//   r_s = (c - g) / (c + g),    r_p = r_s (c g - s^2) / (c g + s^2),    s^2 = 1 - c^2,
//
// Walter et al. 2007, equation 22, in other words. c - g = (1 - eta^2) / (c + g).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "vndf/bsdf/scatter.h"

namespace vndf {

/// Largest absolute error of either reflectance for indices in [0.1, 10]: kFresnelError, divided by
/// g where g < 1, but at most kFresnelErrorAtCriticalAngle, 4 sqrt(epsilon).
template <class T>
inline constexpr T kFresnelError = T(64) * std::numeric_limits<T>::epsilon();
template <class T>
inline constexpr T kFresnelErrorAtCriticalAngle = std::numeric_limits<T>::digits == 24 ? T(1.4e-3)
                                                                                       : T(6e-8);

/// Reflectance of a dielectric, eta = n_o / n_i > 0: of light from outside where eta > 1, from
/// inside where eta < 1, with 1 at total internal reflection. 0 at eta = 1, 1 at grazing otherwise.
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

/// Complex refractive index eta + i k of a metal over that of the side of wi; eta > 0, k >= 0.
template <class T>
struct ComplexIndex {
  T eta, k;
};

/// Reflectance of a conductor; that of a dielectric at k = 0.
template <class T>
T fresnel_conductor(T cosine, const ComplexIndex<T>& index) noexcept {
  // a + i b = sqrt((eta + i k)^2 - s^2) takes the place of g. Of a and b the larger comes from the
  // root, the other from a b = eta k.
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
