// The rows of the two tables: the quantiles of the visible slope x at one incidence, and of the
// slope y given x, as the values that table_coordinates.h defines.
#pragma once

#include <vector>

#include "precompute/fill_table.h"
#include "precompute/unit_slopes.h"
#include "vndf/monotone_map.h"
#include "vndf/table_coordinates.h"

namespace vndf::precompute {

/// How the quantiles of a marginal table are kept.
struct MarginalCoding {
  int order = 1;
  std::vector<CubicNode<double>> nodes = {};
  MonotoneMap<double> map = MonotoneMap<double>(nodes);

  /// Value of the slope sinh(a) in a row that ends at sinh(farthest).
  double value(double a, double farthest) const;
};

/// How those of a conditional table are: the scale of y, and the unit of x on the axis of rows.
struct ConditionalCoding {
  ConditionalScale<double> scale = {};
  double unit = 1;
};

/// Order n at which the tail of `slopes` is stored.
int tail_order(const UnitSlopes& slopes);

/// Both refer to their arguments, which must outlive them.
RowSource marginal_rows(const UnitSlopes& slopes, const MarginalCoding& coding);
RowSource conditional_rows(const UnitSlopes& slopes, const ConditionalCoding& coding);

}  // namespace vndf::precompute
