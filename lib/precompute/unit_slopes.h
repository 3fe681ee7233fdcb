// A slope distribution brought to unit mass and unit mean slope E|X| = 1, with its one-dimensional
// functions ready for the millions of evaluations that inversion needs: log Q and log M over
// a = asinh(x), cubic Hermite between 8192 nodes with their exact derivatives dQ = -P dx and
// dM = -x P dx. Slopes are in units of the mean slope throughout.
#pragma once

#include <functional>

#include "precompute/parallel.h"
#include "precompute/slope_distribution.h"
#include "precompute/slope_integrals.h"
#include "vndf/log_curve.h"

namespace vndf::precompute {

/// Largest relative error of q() and m(): h^4 / 384 times a fourth derivative, 4 at most for the
/// shipped distributions, at h = 20 / 8191; and the rounding of exp() of a large logarithm.
inline constexpr double kCurveError = 5e-13;

class UnitSlopes {
 public:
  /// Integrates `d`, which must outlive this object. Throws std::domain_error as slope_mass() and
  /// mean_slope() do.
  UnitSlopes(const SlopeDistribution& d, const Workers& workers);

  const SlopeDistribution& distribution() const { return distribution_; }
  /// int p22 over the slope plane, as given: the factor by which the density was divided.
  double mass() const { return mass_; }
  /// mu = E|X| of the distribution as given.
  double mean_slope() const { return mean_slope_; }
  /// Largest relative error that the quadrature estimates for P, Q and M at the nodes where Q is at
  /// least 1e-12, the smallest probability in a table.
  double quadrature_error() const { return quadrature_error_; }

  /// Density of slopes at radius r >= 0.
  double p22(double r) const {
    return distribution_.p22(r * mean_slope_) * (mean_slope_ * mean_slope_ / mass_);
  }
  /// Upper tail of X at sinh(a), a >= 0. q(0) = 1/2.
  double q(double a) const { return log_q_.at(a); }
  /// Partial first moment of X beyond sinh(a), a >= 0. m(0) = 1/2.
  double m(double a) const { return log_m_.at(a); }
  /// Density of X times dx/da, at any a: relative error 1e-8.
  double p_da(double a) const {
    const double b = std::abs(a);
    return -log_q_.log_slope_at(b) * log_q_.at(b);
  }

  /// Density and upper tail of X and c Lambda(c) at slopes >= 0, straight from their integrals.
  Estimate density(double x) const;
  Estimate upper_tail(double x) const;
  Estimate backfacing(double c) const;

 private:
  const SlopeDistribution& distribution_;
  double mass_, mean_slope_, quadrature_error_ = 0;
  LogCurve<double> log_q_, log_m_;
};

}  // namespace vndf::precompute
