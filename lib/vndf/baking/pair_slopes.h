// The pair of tables as the kernel sees it: its two quantile functions over q = min(u, 1 - u), with
// their derivatives, in the values and units that the kernel's cells hold (kernel_text.h). Baking
// follows these functions and measures what it made against them.
#pragma once

#include <vector>

#include "vndf/baking/cells.h"
#include "vndf/pair_coordinates.h"
#include "vndf/slope_tables.h"

namespace vndf::baking {

/// What the kernel divides slope y by at slope x, both in units of U: root sqrt(1 + x^2) +
/// constant, or sqrt(rim^2 - x^2) where the rim is not 0.
struct KernelScale {
  double root = 0, constant = 0, rim = 0;

  double at(double x) const;
};

class PairSlopes {
 public:
  /// `pair` must outlive this object. U is `unit` mean slopes.
  PairSlopes(const SlopeTables& pair, double unit);

  const SlopeTables& tables() const { return pair_; }
  double unit() const { return unit_; }
  /// Whether slope y over its scale does not depend on x.
  bool separable() const { return separable_; }
  const KernelScale& scale() const { return scale_; }

  /// The row of the marginal table for the direction of place g = 1 / (1 + |c|), where
  /// c = cot(theta) in units of U, above the horizon or below it.
  double direction_row(double g, bool below) const;
  /// Whether directions below the horizon have rows.
  bool reaches_below() const { return coordinates_.reaches_below(); }
  /// g of the lowest direction that has a row, and |c| from which on nothing is visible from below:
  /// that of the row if slopes are bounded, else infinite.
  double lowest_g() const;
  double most_cotangent() const;
  /// What stands for slope x at u1 = q or, where `upper`, at u1 = 1 - q, with its derivative by q.
  /// It is the root of sigma where the distribution is separable, for then that is smooth; else it
  /// is s of the pair's map, in which every distribution is smooth.
  Node marginal(double row, double q, bool upper) const;
  /// The same for a row below the horizon: the root of sigma over that of g.
  Node marginal_below(double row, double q, bool upper) const;
  /// The root of sigma at s, with its derivative by s.
  Node map(double s) const;
  /// The q at which slope x has `root`.
  double marginal_inverse(double row, double root, bool upper) const;

  /// s of x = 0, rounded to single precision as the kernel has it.
  double middle_s() const { return middle_; }
  /// |x| at s, in units of U.
  double slope_at(double s) const;
  /// The least and the largest s that matter: those that one of 1e9 samples is beyond at grazing
  /// and at normal incidence.
  double least_s() const;
  double most_s() const;
  /// The least root of sigma that matters: that which one of 1e9 samples is beyond at the lowest
  /// direction that has a row.
  double least_root() const;

  /// A row of the conditional table, and what its slopes are multiplied by to be over the kernel's
  /// scale.
  struct ConditionalRow {
    double row, scale;
  };
  /// The row at slope x >= 0, in units of U.
  ConditionalRow conditional_row(double x) const;
  /// -|y| over the kernel's scale for q = min(u2, 1 - u2), with its derivative by q.
  Node conditional(const ConditionalRow& row, double q) const;
  Node conditional(double x, double q) const { return conditional(conditional_row(x), q); }

  /// Logarithms to base 2, at a slope and at a cotangent in units of U: of D (1 + x^2)^2, which is
  /// p22 of the slopes in units of U, and of the area of back-facing facets, c Lambda(c).
  double log2_ndf(double x) const;
  double log2_backfacing(double c) const;

 private:
  double g_of(const BoundedSlope<double>& c) const;
  /// What the marginal table holds, with its derivative by q.
  Node stored(double row, double q, bool upper) const;

  const SlopeTables& pair_;
  PairCoordinates coordinates_;
  double unit_;
  bool separable_;
  double middle_;
  KernelScale scale_;
};

/// The slopes of `pair` in the units in which it may be baked. Where slope y is a closed scale
/// times one variable, that is the unit in which the scale is simple; else those that are worth
/// trying.
std::vector<PairSlopes> pair_in_units(const SlopeTables& pair);

}  // namespace vndf::baking
