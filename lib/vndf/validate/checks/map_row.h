// One row of a map under judgement: the slopes that a subject returns at one incidence, and how far
// their CDFs are from the random numbers that gave them (the u-error), marginal and conditional.
#pragma once

#include <array>
#include <optional>

#include "vndf/validate/exact/exact_conditional.h"
#include "vndf/validate/sampler/sampler_under_test.h"

namespace vndf::validate {

/// The laws of slope y at a slope x, where both have been rounded: near the rim of a compact
/// distribution they change within the rounding. What lies between is no error.
class RoundedConditional {
 public:
  /// Whether the conditional at x is worth judging.
  static bool judged(const precompute::UnitSlopes& slopes, double x);

  /// Some 0.3 ms. `slopes` must outlive this object.
  RoundedConditional(const precompute::UnitSlopes& slopes, double x);

  /// |P(Y <= y) - u|.
  double error(double y, double u) const;
  /// |mass of the tail beyond y / `mass` - 1|, y on the side of `u`.
  double ratio_error(double y, double u, double mass) const;

 private:
  template <class F>
  double least(double y, F error_of) const;

  std::array<ConditionalLaw, 3> laws_;
};

class MapRow {
 public:
  /// `subject` must outlive this object.
  MapRow(const Subject& subject, const Configuration& configuration);

  const Configuration& configuration() const { return configuration_; }

  /// The slope that the subject returns, in the frame of the stretched incident direction.
  StretchedSlope slope(double u1, double u2) const;
  /// Whether a slope can be judged: what is lower than kSmallestHeight lies somewhere beyond.
  static bool carried(const StretchedSlope& s) { return s.w >= kSmallestHeight; }

  /// CDF of the slope x; of one that is not carried, of the largest that is.
  Probability<double> marginal_cdf(const StretchedSlope& s) const;
  /// The law of slope y at the slope x that is sampled at `u1`; nothing where it is not judged.
  std::optional<RoundedConditional> conditional(double u1) const;

 private:
  const Subject& subject_;
  Configuration configuration_;
  StretchedFrame frame_;
  precompute::VisibleSlopes visible_;
};

}  // namespace vndf::validate
