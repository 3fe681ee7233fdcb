// Samples all normals of the Blinn-Phong distribution, visible or not. Isotropic, it is
// D = (n + 2) / (2 pi) cos^n(theta) with n + 2 = 2 / alpha^2 (Walter et al. 2007, section 5.2).
// Anisotropic, n = n_x cos^2(phi) + n_y sin^2(phi) (Ashikhmin and Shirley 2000), normalised so that
// the projected area is 1.
#pragma once

#include <cmath>
#include <numbers>

#include "vndf/reference/azimuthal_ndf.h"
#include "vndf/reference/beckmann.h"
#include "vndf/reference/smith.h"

namespace vndf {

/// The Profile (azimuthal_ndf.h) of Blinn-Phong.
struct BlinnPhongProfile {
  /// Largest |CDF - u| of azimuth and elevation in double and in float, all of it rounding.
  static constexpr double kError = 1e-15, kFloatError = 5e-7;
  /// Largest error of G1 for isotropic alpha up to 1, 0.3 and 0.1 and theta up to 89 degrees. No
  /// closed form is known, so lambda() and g1() are those of Beckmann at the same alpha, as in
  /// Walter et al. 2007 (section 5.2). They mask too little.
  static constexpr double kMaskingError = 0.22, kSmoothMaskingError = 0.014,
                          kMirrorMaskingError = 0.0015;

  /// D at the roughness sqrt(a2), with cos^n = exp(n / 2 log(cos^2)).
  template <class T>
  T density(T cos2, T sin2, T a2) const {
    const T log_cos2 = sin2 < T(0.5) ? std::log1p(-sin2) : std::log(cos2);
    return std::exp((T(1) / a2 - T(1)) * log_cos2) * std::numbers::inv_pi_v<T> / a2;
  }

  /// The theta of 1 - u = cos^(n + 2)(theta).
  template <class T>
  Elevation<T> elevation(const Probability<T>& u, T a2) const {
    const T log_rest = u.u < T(0.5) ? std::log1p(-u.u) : std::log(u.complement);
    const T log_cos2 = a2 * log_rest;
    return {std::sqrt(-std::expm1(log_cos2)), std::exp(log_cos2 / T(2))};
  }
};

/// Draws from D(wm) wm.z. Maximum error: BlinnPhongProfile::kError, in float kFloatError.
template <class T>
using BlinnPhongNdf = AzimuthalNdf<T, BlinnPhongProfile, SmithSurface<T, BeckmannShape>>;

}  // namespace vndf
