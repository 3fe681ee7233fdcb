// A slope distribution brought to unit mass and unit mean slope E|X| = 1. Its one-dimensional
// functions are kept as curves, because inversion evaluates them millions of times: log Q and log M
// over a = asinh(x), cubic Hermite in segments between the breaks of p22. P is the derivative of Q.
// Slopes are in units of the mean slope throughout the builder.
#pragma once

#include <memory>

#include "vndf/distributions/slope_distribution.h"
#include "vndf/distributions/slope_integrals.h"
#include "vndf/log_curve.h"
#include "vndf/support/parallel.h"

namespace vndf::precompute {

/// Largest relative error of q() and m() of a density without breaks. It is h^4 / 384 times a
/// fourth derivative, which is 4 at most for the shipped distributions, at h = 20 / 8191, and the
/// rounding of exp() of a large logarithm.
inline constexpr double kCurveError = 5e-13;

/// Largest relative error of q() and m() of a mixture whose narrowest component is 100 times
/// narrower than the widest.
inline constexpr double kMixtureCurveError = 1e-10;

/// Largest relative error of q() and m() per unit of asinh beyond the last node, sinh(20) = 2.4e8.
/// It is the rounding of the tangent along which a power tail is continued.
inline constexpr double kContinuationError = 2e-11;

class UnitSlopes {
 public:
  /// Integrates `d`, which must outlive this object. Throws std::domain_error as slope_mass() and
  /// mean_slope() do, and where more than 1e-9 of the visible slopes at grazing incidence lie above
  /// 5e303, the end of double precision.
  UnitSlopes(const distributions::SlopeDistribution& d, const support::Workers& workers);

  const distributions::SlopeDistribution& distribution() const { return *distribution_; }
  /// The integral of p22 over the slope plane as given, by which the density was divided.
  double mass() const { return mass_; }
  /// mu = E|X| of the distribution as given, in its own units of slope.
  double mean_slope() const { return mean_slope_; }
  /// Largest relative error that the quadrature estimates for P, Q and M at the nodes where Q is at
  /// least 1e-12, the smallest probability in a table.
  double quadrature_error() const { return quadrature_error_; }

  /// Largest slope, infinite where there is none.
  double support() const { return distribution_->support() / mean_slope_; }
  /// Exponent kappa of a power tail, M(x) ~ x^-kappa; infinite where slopes are bounded or the
  /// exponent is above 100.
  double tail_exponent() const;

  /// Density of slopes at radius r >= 0.
  double p22(double r) const {
    return distribution_->p22(r * mean_slope_) * (mean_slope_ * mean_slope_ / mass_);
  }
  /// Upper tail of X at sinh(a), a >= 0. q(0) = 1/2.
  double q(double a) const { return log_q_.at(a); }
  /// Partial first moment of X beyond sinh(a), a >= 0. m(0) = 1/2.
  double m(double a) const { return log_m_.at(a); }
  /// Density of X times dx/da, at any a: relative error 1e-8 away from breaks.
  double p_da(double a) const {
    const double b = std::abs(a);
    const double q = log_q_.at(b);
    return q > 0 ? -log_q_.log_slope_at(b) * q : 0;
  }

  /// P, Q, M and c Lambda(c) at slopes >= 0, not from the curves: as the distribution knows them in
  /// closed form, or else by quadrature.
  distributions::Estimate density(double x) const;
  distributions::Estimate upper_tail(double x) const;
  distributions::Estimate moment(double x) const;
  distributions::Estimate backfacing(double c) const;

 private:
  std::unique_ptr<distributions::SlopeDistribution>
      interpolated_;  // in place of one that is costly
  const distributions::SlopeDistribution* distribution_;
  double mass_, mean_slope_, quadrature_error_ = 0;
  LogCurve<double> log_q_, log_m_;
};

}  // namespace vndf::precompute
