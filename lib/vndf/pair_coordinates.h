// Where the directions, slopes and values of one pair of tables lie: the coordinates of
// table_coordinates.h with what was made for its distribution, the row axes, the map of the
// marginal and the scale of the conditional. Whoever reads a pair needs them: its sampler, the
// certificate, baking and pictures.
#pragma once

#include "vndf/monotone_map.h"
#include "vndf/row_axis.h"
#include "vndf/slope_tables.h"
#include "vndf/table_coordinates.h"

namespace vndf {

struct PairCoordinates {
  explicit PairCoordinates(const SlopeTables& tables)
      : marginal_rows(tables.marginal_rows),
        conditional_rows(tables.conditional_rows),
        marginal_map(tables.marginal_map),
        scale{tables.conditional_constant, tables.conditional_quadratic} {}

  /// Row coordinate of the marginal table for a direction of cotangent `c`.
  double marginal_row(const BoundedSlope<double>& c) const {
    return marginal_rows.row(marginal_base(c));
  }
  /// Inverse of marginal_row().
  BoundedSlope<double> marginal_row_inverse(double row) const {
    return marginal_base_inverse(marginal_rows.base(row));
  }
  /// Whether the marginal table has rows for directions below the horizon, as all have that are
  /// built.
  bool reaches_below() const { return marginal_rows.base(1) > 1; }

  /// Row coordinate of the conditional table at the slope `x`; the same for x and -x.
  double conditional_row(const BoundedSlope<double>& x) const {
    return conditional_rows.row(conditional_base(x));
  }
  /// Inverse of conditional_row(): the slope |x| >= 0, infinite at row 1.
  double conditional_row_inverse(double row) const {
    return conditional_base_inverse(conditional_rows.base(row));
  }

  RowAxis marginal_rows, conditional_rows;
  MonotoneMap marginal_map;        ///< from the values of the marginal table to sigma(x)
  ConditionalScale<double> scale;  ///< by which slopes y of the conditional table are divided
};

}  // namespace vndf
