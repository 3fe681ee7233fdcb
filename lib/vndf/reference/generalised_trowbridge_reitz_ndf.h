// Samples all normals of the generalised Trowbridge-Reitz distribution, visible or not (Burley
// 2012, appendix B): D = c (1 + (alpha^2 - 1) cos^2(theta))^-gamma, which is GGX at gamma = 2.
#pragma once

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "vndf/reference/azimuthal_ndf.h"
#include "vndf/reference/ggx.h"
#include "vndf/reference/smith.h"

namespace vndf {

/// The Profile (azimuthal_ndf.h) of the generalised Trowbridge-Reitz distribution, evaluated in
/// double.
///
/// Let L = log(alpha^2), g = gamma - 1 and t = 1 + (alpha^2 - 1) cos^2(theta) = exp(w). The
/// normalised mass below theta is 1 - (exp(-g w) - 1) / (exp(-g L) - 1), where w runs from L at the
/// pole to 0 at the horizon. gamma = 1 and alpha = 1 are limits, which we reach by replacing a g or
/// L of 0 by a number too small to matter.
class GtrProfile {
 public:
  /// The valid range of gamma.
  static constexpr double kMinGamma = 0.1, kMaxGamma = 10;
  /// Largest |CDF - u| of azimuth and elevation in double and in float, all of it rounding.
  static constexpr double kError = 2e-14, kFloatError = 5e-7;
  /// Largest error of G1 at gamma = 1, 1.5 and 3, for isotropic alpha from 0.01 to 1 and theta up
  /// to 89 degrees. No closed form is known for general gamma, so lambda() and g1() are those of
  /// GGX at the same alpha, which are exact only at gamma = 2. They mask too much above it and too
  /// little below it, and must not be used where masking has to be that of D.
  static constexpr double kMaskingErrorAt1 = 0.79, kMaskingErrorAt1_5 = 0.32,
                          kMaskingErrorAt3 = 0.25;

  /// Throws std::invalid_argument for a gamma outside [kMinGamma, kMaxGamma].
  explicit GtrProfile(double gamma = 2) : g_(nonzero(gamma - 1)) {
    if (!(gamma >= kMinGamma && gamma <= kMaxGamma))
      throw std::invalid_argument("generalised Trowbridge-Reitz: gamma is " +
                                  std::to_string(gamma) + ", but must be from 0.1 to 10");
  }

  template <class T>
  T density(T cos2, T sin2, T a2) const {
    const double log_a2 = nonzero(std::log(double{a2}));
    // t = sin^2 + alpha^2 cos^2; c = g (alpha^2 - 1) / (pi (1 - alpha^(-2 g)))
    const double t = double{sin2} + double{a2} * double{cos2};
    const double c = g_ * std::expm1(log_a2) / -std::expm1(-g_ * log_a2);
    return static_cast<T>(c * std::exp(-(g_ + 1) * std::log(t)) * std::numbers::inv_pi);
  }

  template <class T>
  Elevation<T> elevation(const Probability<T>& u, T a2) const {
    const double log_a2 = nonzero(std::log(double{a2}));
    const double scale = std::expm1(log_a2);
    const double rest = 1 - double{u.u};
    // w for the cosine and L - w for the sine, neither of which cancels
    const double w = std::log1p(rest * std::expm1(-g_ * log_a2)) / -g_;
    const double from_pole = std::log1p(double{u.u} * std::expm1(g_ * log_a2)) / g_;
    // cos^2 = (t - 1) / (alpha^2 - 1), sin^2 = (alpha^2 - t) / (alpha^2 - 1)
    const double cos2 = std::expm1(w) / scale;
    const double sin2 = -std::exp(log_a2) * std::expm1(-from_pole) / scale;
    return {static_cast<T>(std::sqrt(std::abs(sin2))), static_cast<T>(std::sqrt(std::abs(cos2)))};
  }

 private:
  static double nonzero(double v) {
    constexpr double kTooSmallToMatter = 1e-100;
    return std::abs(v) < kTooSmallToMatter ? kTooSmallToMatter : v;
  }

  double g_;
};

/// Draws from D(wm) wm.z, for example `GeneralisedTrowbridgeReitzNdf<float>(GtrProfile(1.5))`.
/// Maximum error: GtrProfile::kError, in float kFloatError.
template <class T>
using GeneralisedTrowbridgeReitzNdf = AzimuthalNdf<T, GtrProfile, SmithSurface<T, GgxShape>>;

}  // namespace vndf
