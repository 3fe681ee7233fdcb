// The Beckmann distribution in closed form at unit roughness. Its slopes are Gaussian,
// p22(r) = exp(-r^2) / pi (Heitz and d'Eon 2014, supplemental 1, section 3).
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "vndf/stretch.h"
#include "vndf/table_coordinates.h"

namespace vndf {

/// The Shape (smith.h) of Beckmann.
struct BeckmannShape {
  /// Largest relative error of density() in roundings of T at slopes of at most 5, which 1e-11 of
  /// the normals exceed. It comes from the rounding of the exponent, which is up to 25.
  static constexpr double kDensityRoundings = 60;
  /// Largest relative error of G1 in roundings of T, which is the error of Lambda relative to
  /// 1 + Lambda.
  static constexpr double kLambdaRoundings = 4;

  /// exp(-h2 / z^2) / (pi z^4), with one exponential for both factors because each alone may leave
  /// the range of T.
  template <class T>
  static T density(T h2, T z) {
    const T square = z * z;
    if (square == T(0)) return T(0);
    return std::exp(-h2 / square - T(2) * std::log(square)) * std::numbers::inv_pi_v<T>;
  }

  /// z Lambda = (s exp(-c^2) / sqrt(pi) - z erfc(c)) / 2, where c = z / s = cot(theta).
  template <class T>
  static T backfacing_area(T z, T s) {
    const T c = z / s;
    const T area = s * std::exp(-c * c) * std::numbers::inv_sqrtpi_v<T> - z * std::erfc(c);
    return std::max(T(0), area / T(2));
  }

  /// The slope along the azimuth `angle`, in turns, whose radius r another slope exceeds with
  /// probability 1 - u = exp(-r^2).
  template <class T>
  static HomogeneousSlope<T> polar_slope(const Probability<T>& u, T angle) {
    const T r = u.u < T(0.5) ? std::sqrt(-std::log1p(-u.u)) : std::sqrt(-std::log(u.complement));
    const T phi = T(2) * std::numbers::pi_v<T> * angle;
    if (std::isinf(r)) return {std::cos(phi), std::sin(phi), T(0)};
    return {r * std::cos(phi), r * std::sin(phi), T(1)};
  }
};

}  // namespace vndf
