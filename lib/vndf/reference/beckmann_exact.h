// The exact map for visible Beckmann slopes, slope_x from u1 and slope_y from u2, with which other
// samplers of Beckmann are compared. Everything is evaluated in double precision.
//
// Marginal distribution (Heitz and d'Eon 2014, equation 11; supplemental 1, section 3.2), inverted
// by bracketed root finding:
//
//   V(x)     = [cos F(x) + sin M(x)] / N,           F = erfc(-x) / 2, M = exp(-x^2) / (2 sqrt(pi))
//   1 - V(x) = sin int_x^c (c - t) P(t) dt / N,     c = cot(theta), P = 2 M, used near u = 1
//
// Conditional distribution: y = erf_inverse(2 u2 - 1).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "vndf/cubic_piece.h"
#include "vndf/reference/beckmann.h"
#include "vndf/reference/erf_inverse.h"
#include "vndf/reference/smith.h"
#include "vndf/support/increasing_root.h"

namespace vndf {

/// The marginal distribution of visible Beckmann slopes at one incidence.
class VisibleBeckmannSlopes {
 public:
  /// Largest relative error of lower() and upper() for tails of 1e-12 and more.
  static constexpr double kTailError = 1e-12;

  explicit VisibleBeckmannSlopes(const Incidence<double>& wi)
      : wi_(wi), cotangent_(wi.cos / wi.sin), norm_(lower_mass(cotangent_)) {}

  /// V(x), x <= cot(theta).
  double lower(double x) const { return lower_mass(x) / norm_; }
  /// 1 - V(x), x <= cot(theta).
  double upper(double x) const { return upper_mass(x) / norm_; }

  /// x with V(x) = u, which is -infinity at u = 0 and cot(theta) at u = 1. Maximum error: that of
  /// lower() or upper(), whichever is smaller at x.
  double quantile(const Probability<double>& u) const {
    if (u.u == 0) return -std::numeric_limits<double>::infinity();
    if (u.complement == 0) return cotangent_;
    // Both branches solve for the logarithm of a mass, which is close to a parabola in the tail.
    const double guess = u.u < 0.5 ? -erfc_inverse(2 * u.u) : erfc_inverse(2 * u.complement);
    const double high = std::min(cotangent_, kFarthest);
    if (u.u <= 0.5)
      return support::increasing_root(
          [&](double x) {
            const double mass = lower_mass(x);
            return WithDerivative<double>{std::log(mass / (u.u * norm_)), density(x) / mass};
          },
          -kFarthest, high, std::min(guess, high));
    return support::increasing_root(
        [&](double x) {
          const double mass = upper_mass(x);
          return WithDerivative<double>{std::log(u.complement * norm_ / mass), density(x) / mass};
        },
        -kFarthest, high, guess);
  }

 private:
  // Beyond 27.3 erfc is below the range of double.
  static constexpr double kFarthest = 28;

  /// F(-x).
  static double q(double x) { return std::erfc(x) / 2; }
  /// M(x), corrected for the rounding of x^2, which would otherwise cost x^2 roundings.
  static double m(double x) {
    if (std::isinf(x)) return 0;
    const double square = x * x;
    return std::exp(-square) * (1 - std::fma(x, x, -square)) * std::numbers::inv_sqrtpi / 2;
  }

  /// sin (c - x), with a single rounding however close x is to c.
  double projection(double x) const { return std::fma(-x, wi_.sin, wi_.cos); }
  double density(double x) const { return projection(x) * 2 * m(x); }
  double lower_mass(double x) const { return wi_.cos * q(-x) + wi_.sin * m(x); }

  double upper_mass(double x) const {
    const double width = projection(x) / wi_.sin;
    if (width <= 0) return 0;
    // Closer to c than this the closed form cancels. Elsewhere it loses a factor of at most 40.
    constexpr double kNear = 2;
    if (width * (1 + cotangent_) < kNear) return upper_mass_near(width);
    return wi_.cos * (q(x) - q(cotangent_)) - wi_.sin * (m(x) - m(cotangent_));
  }

  /// sin int_0^width s P(c - s) ds by Gauss's rule of 10 points, which is exact to rounding as long
  /// as the exponent of P varies by no more than 2 kNear.
  double upper_mass_near(double width) const {
    constexpr double kNodes[]{0.14887433898163121, 0.43339539412924719, 0.67940956829902441,
                              0.86506336668898451, 0.97390652851717172};
    constexpr double kWeights[]{0.29552422471475287, 0.26926671930999636, 0.21908636251598204,
                                0.14945134915058059, 0.06667134430868814};
    double sum = 0;
    for (int k = 0; k < 5; ++k)
      for (const double node : {-kNodes[k], kNodes[k]}) {
        const double s = width * (1 + node) / 2;
        sum += kWeights[k] * s * 2 * m(cotangent_ - s);
      }
    return wi_.sin * sum * width / 2;
  }

  Incidence<double> wi_;
  double cotangent_, norm_;
};

/// The Method (smith.h) of BeckmannExact.
struct BeckmannExactMethod {
  /// Largest |CDF - u| of both slopes for u in [1e-12, 1 - 1e-12] and theta from 0 to 90 degrees,
  /// in double, and in float at azimuth 0, where it is the rounding of wi and of the normal.
  static constexpr double kDoubleError = 1e-15, kFloatError = 2e-7;

  template <class T>
  static HomogeneousSlope<T> sample_slope(const Incidence<T>& wi, const Probability<T>& u1,
                                          const Probability<T>& u2) {
    const double x = VisibleBeckmannSlopes(in_double(wi)).quantile(in_double(u1));
    const auto folded = fold(in_double(u2));
    const double y = double{folded.sign} * erfc_inverse(folded.p.complement);
    return homogeneous_slope(static_cast<T>(x), static_cast<T>(y));
  }
};

/// slope_x increases with u1 and slope_y with u2 in the frame of the stretched incident direction.
template <class T>
using BeckmannExact = VisibleSampler<T, BeckmannShape, BeckmannExactMethod>;

}  // namespace vndf
