// One row of a map under test: the slopes that a sampler returns at one incidence, and how far
// their CDFs are from the random numbers that gave them (the u-error), marginal and conditional.
#pragma once

#include <array>
#include <optional>

#include "vndf/validate/exact/exact_conditional.h"
#include "vndf/validate/sampler/sampler_under_test.h"

namespace vndf::validate {

/// The distributions of slope y at a slope x, where both have been rounded: near the rim of a
/// compact distribution they change within the rounding. What lies between is no error.
class RoundedConditional {
 public:
  /// Whether the conditional at x is worth checking.
  static bool is_checked(const precompute::UnitSlopes& slopes, double x);

  /// Some 0.3 ms. `slopes` must outlive this object.
  RoundedConditional(const precompute::UnitSlopes& slopes, double x);

  /// |P(Y <= y) - u|.
  double error(double y, double u) const;
  /// |mass of the tail beyond y / `mass` - 1|, y on the side of `u`.
  double ratio_error(double y, double u, double mass) const;

 private:
  template <class F>
  double least(double y, F error_of) const;

  std::array<ExactConditional, 3> conditionals_;
};

class MapRow {
 public:
  /// `sampler` must outlive this object.
  MapRow(const SamplerUnderTest& sampler, const Configuration& configuration);

  const Configuration& configuration() const { return configuration_; }

  /// The slope that the sampler returns, in the frame of the stretched incident direction.
  StretchedSlope slope(double u1, double u2) const;
  /// Whether a slope can be checked: what is lower than kSmallestHeight lies somewhere beyond.
  static bool carried(const StretchedSlope& s) { return s.w >= kSmallestHeight; }

  /// CDF of the slope x; of one that is not carried, of the largest that is.
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
