// The GGX (Trowbridge-Reitz) distribution in closed form at unit roughness:
// p22(r) = 1 / (pi (1 + r^2)^2) (Heitz and d'Eon 2014, supplemental 1, section 4; Lambda: Walter et
// al. 2007, equation 34).
#pragma once

#include <cmath>
#include <numbers>

#include "vndf/stretch.h"
#include "vndf/table_coordinates.h"

namespace vndf {

/// The Shape (smith.h) of GGX.
struct GgxShape {
  /// Largest relative error of density() in roundings of T, at any slope.
  static constexpr double kDensityRoundings = 8;
  /// Largest relative error of G1 in roundings of T, and also of Lambda, because nothing cancels.
  static constexpr double kLambdaRoundings = 4;

  /// 1 / (pi (h2 + z^2)^2).
  template <class T>
  static T density(T h2, T z) {
    const T square = h2 + z * z;
    return std::numbers::inv_pi_v<T> / (square * square);
  }

  /// z Lambda = (sqrt(s^2 + z^2) - z) / 2, evaluated without cancellation.
  template <class T>
  static T backfacing_area(T z, T s) {
    return s * (s / (z + std::hypot(z, s))) / T(2);
  }

  /// The slope along the azimuth `angle`, in turns, whose radius r another slope exceeds with
  /// probability 1 - u = 1 / (1 + r^2).
  template <class T>
  static HomogeneousSlope<T> polar_slope(const Probability<T>& u, T angle) {
    const T r = std::sqrt(u.u), phi = T(2) * std::numbers::pi_v<T> * angle;
    return {r * std::cos(phi), r * std::sin(phi), std::sqrt(u.complement)};
  }
};

}  // namespace vndf
