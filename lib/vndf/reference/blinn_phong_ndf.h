// All normals of the Blinn-Phong distribution, visible or not: D = (n + 2) / (2 pi) cos^n(theta),
// n + 2 = 2 / alpha^2 (Walter et al. 2007, section 5.2); anisotropic, n = n_x cos^2(phi) +
// n_y sin^2(phi) (Ashikhmin and Shirley 2000), normalised to project to area 1.
#pragma once

#include <cmath>
#include <numbers>

#include "vndf/reference/azimuthal_ndf.h"
#include "vndf/reference/beckmann.h"
#include "vndf/reference/smith.h"

namespace vndf {

struct BlinnPhongProfile {
  /// Largest |CDF - u| of azimuth and elevation in double and in float, which is rounding.
  static constexpr double kError = 1e-15, kFloatError = 5e-7;
  /// Largest error of G1, of which no closed form is known: lambda() and g1() are those of Beckmann
  /// at the same alpha, as Walter et al. 2007 (section 5.2) do. They mask too little. Isotropic,
  /// theta to 89 degrees: alpha to 1, to 0.3 and to 0.1.
  static constexpr double kMaskingError = 0.22, kSmoothMaskingError = 0.014,
                          kMirrorMaskingError = 0.0015;

  /// cos^(n + 2) = exp((n + 2) / 2 log(cos^2)).
  template <class T>
  T density(T cos2, T sin2, T a2) const {
    const T log_cos2 = sin2 < T(0.5) ? std::log1p(-sin2) : std::log(cos2);
    return std::exp((T(1) / a2 - T(1)) * log_cos2) * std::numbers::inv_pi_v<T> / a2;
  }

  /// 1 - u = cos^(n + 2).
  template <class T>
  Elevation<T> elevation(const Probability<T>& u, T a2) const {
    const T log_rest = u.u < T(0.5) ? std::log1p(-u.u) : std::log(u.complement);
    const T log_cos2 = a2 * log_rest;
    return {std::sqrt(-std::expm1(log_cos2)), std::exp(log_cos2 / T(2))};
  }
};

template <class T>
using BlinnPhongNdf = AzimuthalNdf<T, BlinnPhongProfile, SmithSurface<T, BeckmannShape>>;

}  // namespace vndf
