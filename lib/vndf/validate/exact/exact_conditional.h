// The exact distribution of the slope y given the slope x, of either sign, in units of the mean
// slope.
#pragma once

#include <algorithm>
#include <cmath>

#include "vndf/precompute/conditional_distribution.h"
#include "vndf/validate/exact/exact_distribution.h"

namespace vndf::validate {

/// Slopes x that fewer than this lie beyond are left out: their conditionals check nothing that a
/// sampler returns.
inline constexpr double kSmallestMass = 1e-7;

class ExactConditional {
 public:
  /// Whether the conditional at x is worth checking.
  static bool is_checked(const precompute::UnitSlopes& slopes, double x) {
    return std::isfinite(x) && slopes.m(std::asinh(std::abs(x))) > kSmallestMass &&
           precompute::ConditionalDistribution::reachable(slopes, std::abs(x));
  }

  /// Some 0.1 ms. `slopes` must outlive this object.
  ExactConditional(const precompute::UnitSlopes& slopes, double x)
      : slopes_(slopes, std::abs(x), precompute::plain_scale(slopes)),
        bounded_(std::isfinite(slopes.support())) {}

  /// P(Y <= y) with its complement.
  Probability<double> cdf(double y) const {
    const double scaled = std::abs(y) / slopes_.scale();
    const double half = slopes_.cdf(bounded_ ? std::min(scaled, 1.0) : scaled).complement / 2;
    return y < 0 ? Probability<double>{half, 1 - half} : Probability<double>{1 - half, half};
  }

  /// Inverse of cdf().
  double quantile(const Probability<double>& u) const {
    const auto folded = fold(u);
    return folded.sign * slopes_.scale() * slopes_.quantile(folded.p);
  }

 private:
  precompute::ConditionalDistribution slopes_;
  bool bounded_;
};

}  // namespace vndf::validate
