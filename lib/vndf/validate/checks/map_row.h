// One row of the map of a sampler under test: the slopes that it returns at one incidence, and how
// far their CDFs are from the random numbers that gave them (the u-error), for the marginal and for
// the conditional. It serves the u-error check and the pictures of the u-error.
#pragma once

#include <array>
#include <optional>

#include "vndf/validate/exact/exact_conditional.h"
#include "vndf/validate/sampler/sampler_under_test.h"

namespace vndf::validate {

/// The distribution of slope y at slope x, where both slopes have been rounded. Near the rim of a
/// compact distribution the CDF changes within this rounding by more than any bound, so only what
/// no rounding explains counts as an error.
class RoundedConditional {
 public:
  /// Whether the conditional at slope x is checked (ExactConditional).
  static bool is_checked(const precompute::UnitSlopes& slopes, double x);

  /// Takes some 0.3 ms. `slopes` must outlive this object.
  RoundedConditional(const precompute::UnitSlopes& slopes, double x);

  /// The smallest |P(Y <= y) - u| within the rounding.
  double error(double y, double u) const;
  /// The smallest |mass of the tail beyond y / `mass` - 1| within the rounding, for the tail on the
  /// side of `u`.
  double ratio_error(double y, double u, double mass) const;

 private:
  template <class F>
  double least(double y, F error_of) const;

  std::array<ExactConditional, 3> conditionals_;
};

/// The slopes of a sampler at one configuration, and their exact CDFs.
class MapRow {
 public:
  /// `sampler` must outlive this object.
  MapRow(const SamplerUnderTest& sampler, const Configuration& configuration);

  const Configuration& configuration() const { return configuration_; }

  /// The slope that the sampler returns, in the frame of the stretched incident direction.
  StretchedSlope slope(double u1, double u2) const;
  /// Whether a slope follows from the normal. What is lower than kSmallestHeight is only known to
  /// lie beyond.
  static bool carried(const StretchedSlope& s) { return s.w >= kSmallestHeight; }

  /// The exact CDF of the slope x; of one that is not carried, that of the largest that is.
  Probability<double> marginal_cdf(const StretchedSlope& s) const;
  /// The distribution of slope y at the slope x that is sampled at `u1`; nothing where it is not
  /// checked.
  std::optional<RoundedConditional> conditional(double u1) const;

 private:
  const SamplerUnderTest& sampler_;
  Configuration configuration_;
  StretchedFrame frame_;
  precompute::MarginalDistribution visible_;
};

}  // namespace vndf::validate
