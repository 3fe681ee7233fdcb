// The exact distribution of the slope y given the slope x, of either sign, in units of the mean
// slope. It tells the u-error of slope y.
//
// It is the builder's ConditionalDistribution (Heitz and d'Eon 2014, equations 12 and 13), unfolded
// to both signs of y and taken in a scale of its own. Of the builder's root finding only
// quantile() makes use, for the normals of the cross-check; the u-error of a map needs the CDF
// alone. Sharing the integral is safe for two reasons. It is compared with closed forms and, for
// the distributions of tests/data/reference_values.csv, with values from 40-digit arithmetic by
// another program. And the distribution check counts the azimuths of the same samples by a closed
// form in polar slopes (exact_distribution.h), in which this integral does not occur: were the
// conditional wrong, tables that follow it would fail there by any error that counts can show.
#pragma once

#include <algorithm>
#include <cmath>

#include "vndf/precompute/conditional_distribution.h"
#include "vndf/validate/exact/exact_distribution.h"

namespace vndf::validate {

/// A slope x is left out where the partial first moment of the slopes beyond it is smaller than
/// this: hardly any sample lands there, and the conditional says nothing of the others.
inline constexpr double kSmallestMass = 1e-7;

class ExactConditional {
 public:
  /// Whether the conditional at slope x is checked: enough of the slopes lie beyond it, and the
  /// density near it can be told from 0.
  static bool is_checked(const precompute::UnitSlopes& slopes, double x) {
    return std::isfinite(x) && slopes.m(std::asinh(std::abs(x))) > kSmallestMass &&
           precompute::ConditionalDistribution::reachable(slopes, std::abs(x));
  }

  /// Integrates the conditional at a slope x for which is_checked() holds, which takes some 0.1 ms.
  /// `slopes` must outlive this object.
  ExactConditional(const precompute::UnitSlopes& slopes, double x)
      : slopes_(slopes, std::abs(x), precompute::plain_scale(slopes)),
        bounded_(std::isfinite(slopes.support())) {}

  /// P(Y <= y | x) and its complement, each with its own relative precision. Maximum error: that of
  /// ConditionalDistribution::cdf().
  Probability<double> cdf(double y) const {
    const double scaled = std::abs(y) / slopes_.scale();
    const double half = slopes_.cdf(bounded_ ? std::min(scaled, 1.0) : scaled).complement / 2;
    return y < 0 ? Probability<double>{half, 1 - half} : Probability<double>{1 - half, half};
  }

  /// The slope y with cdf(y) = u. Maximum error 1e-12 in u.
  double quantile(const Probability<double>& u) const {
    const auto folded = fold(u);
    return folded.sign * slopes_.scale() * slopes_.quantile(folded.p);
  }

 private:
  precompute::ConditionalDistribution slopes_;
  bool bounded_;
};

}  // namespace vndf::validate
