// The distribution of the slope y given the slope x (Heitz and d'Eon 2014, equations 12 and 13). It
// does not depend on the incident direction and is symmetric, so only that of |y| is needed:
//
//   P(|Y| < y | x) = int_0^y p22(sqrt(x^2 + s^2)) ds / int_0^inf p22(sqrt(x^2 + s^2)) ds
//
// y is in units of a scale sqrt(A + B x^2), because with the right A and B the conditionals of
// Gaussian, Student-T and Pearson II slopes are the same at every x (conditional_shape.h). x is in
// units of the mean slope.
#pragma once

#include "vndf/precompute/tabulated_cdf.h"
#include "vndf/precompute/unit_slopes.h"
#include "vndf/table_coordinates.h"

namespace vndf::precompute {

/// The scale to take where no better one is known: sqrt(1 + x^2) or, where no slope is larger than
/// R, sqrt(R^2 - x^2), the largest y.
ConditionalScale<double> plain_scale(const UnitSlopes& slopes);

class ConditionalDistribution {
 public:
  /// Whether slopes near `x` >= 0 have any mass in double precision. Where they have none, no
  /// sample ever has that slope and the conditional is not defined.
  static bool reachable(const UnitSlopes& slopes, double x);

  /// Integrates the conditional density at a reachable slope `x` >= 0, panel by panel, with y in
  /// units of `scale`. `slopes` must outlive this object.
  ConditionalDistribution(const UnitSlopes& slopes, double x,
                          const ConditionalScale<double>& scale);

  /// The scale that y is in units of.
  double scale() const { return scale_; }

  /// P(|Y| < y) and its complement at y >= 0. Maximum error: 1e-13 for smooth densities, relative
  /// to the smaller of the two.
  Probability<double> cdf(double y) const { return cdf_.cdf(y); }

  /// y with P(|Y| < y) = p, to 1e-12 in p. At p = 1 it is infinity, or 1 for a compact
  /// distribution.
  double quantile(const Probability<double>& p) const;

  /// Relative error of the whole integral that the quadrature estimates.
  double quadrature_error() const { return cdf_.error() / cdf_.above_first(); }

 private:
  /// p22 along y, not normalised.
  struct Density {
    const UnitSlopes* slopes;
    double x, scale;

    double operator()(double y) const;
  };

  static TabulatedCdf<Density> integrate(const Density& density);

  double scale_;
  bool bounded_;
  TabulatedCdf<Density> cdf_;
};

}  // namespace vndf::precompute
