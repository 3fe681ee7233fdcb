// All normals of the generalised Trowbridge-Reitz distribution, visible or not (Burley 2012,
// appendix B): D = c (1 + (alpha^2 - 1) cos^2(theta))^-gamma. gamma = 2 is GGX.
#pragma once

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "vndf/reference/azimuthal_ndf.h"
#include "vndf/reference/ggx.h"
#include "vndf/reference/smith.h"

namespace vndf {

/// Evaluated in double. Let L = log(alpha^2) and g = gamma - 1. The normalised mass below theta,
/// with t = 1 + (alpha^2 - 1) cos^2(theta) = exp(w), is 1 - (exp(-g w) - 1) / (exp(-g L) - 1),
/// and w runs from L at the pole to 0 at the horizon. gamma = 1 and alpha = 1 are limits, which a g
/// or L too small to matter takes.
class GtrProfile {
 public:
  /// Range of gamma.
  static constexpr double kMinGamma = 0.1, kMaxGamma = 10;
  /// Largest |CDF - u| of azimuth and elevation in double and in float, which is rounding.
  static constexpr double kError = 2e-14, kFloatError = 5e-7;
  /// Largest error of G1, of which no closed form is known for general gamma: lambda() and g1() are
  /// those of GGX at the same alpha, exact at gamma = 2 only. They mask too much above it and too
  /// little below. Isotropic, alpha from 0.01 to 1, theta to 89 degrees, at gamma = 1, 1.5 and 3:
  /// too much for anything that relies on masking being that of D.
  static constexpr double kMaskingErrorAt1 = 0.79, kMaskingErrorAt1_5 = 0.32,
                          kMaskingErrorAt3 = 0.25;

  /// Throws std::invalid_argument for a gamma outside its range.
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
    // w, and L - w where w is near L, without cancellation
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

/// GeneralisedTrowbridgeReitzNdf<T>(GtrProfile(gamma)).
template <class T>
using GeneralisedTrowbridgeReitzNdf = AzimuthalNdf<T, GtrProfile, SmithSurface<T, GgxShape>>;

}  // namespace vndf
