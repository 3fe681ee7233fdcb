// The distribution of the slope y given the slope x (Heitz and d'Eon 2014, equations 12 and 13). It
// does not depend on the incident direction and is symmetric, so it is kept as that of |y|:
//
//   P(|Y| < y | x) = int_0^y p22(sqrt(x^2 + s^2)) ds / int_0^inf p22(sqrt(x^2 + s^2)) ds
//
// y is in units of a scale that depends on x: sqrt(A + B x^2), with the A and B in which the
// conditionals of Gaussian, Student-T or Pearson II slopes are one and the same. x is in units of
// the mean slope.
#pragma once

#include <vector>

#include "vndf/precompute/unit_slopes.h"
#include "vndf/table_coordinates.h"

namespace vndf::precompute {

/// The scale where no better one is known: sqrt(1 + x^2) or, where no slope is larger than R,
/// sqrt(R^2 - x^2), the largest y.
ConditionalScale<double> plain_scale(const UnitSlopes& slopes);

class ConditionalDistribution {
 public:
  /// Whether slopes near `x` >= 0 have any mass in double precision. Where they have none, no
  /// sample ever lands and the conditional is not defined.
  static bool reachable(const UnitSlopes& slopes, double x);

  /// Integrates the conditional density at a reachable slope `x` >= 0, panel by panel, with y in
  /// units of `scale`. `slopes` must outlive this object.
  ConditionalDistribution(const UnitSlopes& slopes, double x,
                          const ConditionalScale<double>& scale);

  /// The scale that y is in units of.
  double scale() const { return scale_; }

  /// P(|Y| < y) and its complement at y >= 0. Maximum error: 1e-13 for smooth densities, in both
  /// tails relative.
  Probability<double> cdf(double y) const;

  /// y with P(|Y| < y) = p; infinity, or 1 for a compact distribution, at 1: bracketed root finding
  /// to 1e-12 in p.
  double quantile(const Probability<double>& p) const;

  /// Relative error that the quadrature estimates for the whole integral.
  double quadrature_error() const { return error_ / total(); }

 private:
  std::vector<double> breaks_in_y() const;
  std::vector<double> panel_edges(double width) const;
  double density(double y) const;  // not normalised
  double rest();
  double total() const { return tail_.front(); }
  double partial(double low, double high) const;
  double inverse_hermite(std::size_t panel, double tail) const;
  std::size_t panel_of(double y) const;
  std::size_t panel_of_tail(double mass) const;

  const UnitSlopes& slopes_;
  bool bounded_;
  double x_, scale_;
  double error_ = 0;
  // Edges of the panels and the integrals below and above each edge: both are sums of positive
  // terms, so neither tail is a difference.
  std::vector<double> edge_, head_, tail_;
};

}  // namespace vndf::precompute
