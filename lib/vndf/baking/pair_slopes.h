// The pair of tables as the kernel sees it: its two quantile functions over q = min(u, 1 - u), with
// their derivatives, in the values and the units that the kernel's cells hold (kernel_text.h).
#pragma once

#include "vndf/baking/cells.h"
#include "vndf/monotone_map.h"
#include "vndf/row_axis.h"
#include "vndf/slope_tables.h"
#include "vndf/table_coordinates.h"

namespace vndf::baking {

/// What slope y is divided by, at slope x, both in units of U: scale_root sqrt(1 + x^2) +
/// scale_constant, or sqrt(rim^2 - x^2) where the rim is not 0.
struct KernelScale {
  double root = 0, constant = 0, rim = 0;

  double at(double x) const;
};

class PairSlopes {
 public:
  /// `pair` must outlive this object; slopes are in units of `unit` mean slopes.
  PairSlopes(const SlopeTables& pair, double unit);

  double unit() const { return unit_; }
  bool separable() const { return separable_; }
  const KernelScale& scale() const { return scale_; }

  /// The row of the marginal table for the direction of place g = 1 / (1 + c), c = cot(theta) in
  /// units of U.
  double direction_row(double g) const;
  /// What stands for slope x at u1 = q, or at 1 - q above one half: the root of its sigma where the
  /// law is separable and so is smooth; else s of the pair's map, in which any law is.
  Node marginal(double row, double q, bool upper) const;
  /// The root of sigma at s.
  Node map(double s) const;
  /// The q at which slope x has `root`.
  double marginal_inverse(double row, double root, bool upper) const;

  /// s of x = 0, as single precision has it.
  double middle_s() const { return middle_; }
  /// |x| of slope x at s, in units of U.
  double slope_at(double s) const;
  /// The least and the largest s that matter: one in 1e9 samples is beyond, at grazing and at
  /// normal incidence.
  double least_s() const;
  double most_s() const;
  /// The row of the conditional table at slope x >= 0, in units of U, and what its slopes are
  /// multiplied by to be over the kernel's scale.
  struct ConditionalRow {
    double row, scale;
  };
  ConditionalRow conditional_row(double x) const;
  /// -|y| over its scale for q = min(u2, 1 - u2).
  Node conditional(const ConditionalRow& row, double q) const;
  Node conditional(double x, double q) const { return conditional(conditional_row(x), q); }

  /// log2 of D of the unit surface without its Jacobian, and of the back-facing area, at a slope
  /// and a cotangent in units of U.
  double log2_ndf(double x) const;
  double log2_backfacing(double c) const;

 private:
  const SlopeTables& pair_;
  double unit_;
  bool separable_;
  RowAxis marginal_rows_, conditional_rows_;
  MonotoneMap map_;
  double middle_;
  KernelScale scale_;
};

/// The units in which `pair` may be baked: where slope y is a closed scale times one variable, the
/// one in which that scale is simple; else the ones that are worth trying.
std::vector<double> units_to_try(const SlopeTables& pair);

}  // namespace vndf::baking
