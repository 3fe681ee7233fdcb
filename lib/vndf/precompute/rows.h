// The rows of the two tables: the quantiles of the visible slope x at one incidence, and of the
// slope y given x, as the values that table_coordinates.h defines.
#pragma once

#include <functional>
#include <vector>

#include "vndf/monotone_map.h"
#include "vndf/precompute/unit_slopes.h"
#include "vndf/table_coordinates.h"

namespace vndf::precompute {

/// A table before its rows are placed: what its row at any base coordinate is.
struct RowSource {
  /// Returns the values of the row at a base coordinate, at the columns whose probabilities are
  /// `u`. The row is empty where no sample lands.
  std::function<std::vector<double>(double base, const std::vector<Probability<double>>& u)> row;
  /// The probability that a column coordinate in [0, 1] stands for.
  Probability<double> (*column_inverse)(double);
  /// Rows run from base coordinate 0 to this one. Nothing is sampled beyond it.
  double end = 1;
  /// Base coordinates, in (0, end), at which the table has a kink.
  std::vector<double> breaks = {};
};

/// Rows of the marginal table for directions above the horizon, whose values go through `map`
/// (marginal_map.h). Both arguments must outlive the result.
RowSource marginal_rows(const UnitSlopes& slopes, const MonotoneMap& map);

/// Rows of the marginal table for directions below the horizon, at base coordinates less 1: from
/// grazing incidence to the last direction that sees a part of 1e-13 of the surface.
RowSource marginal_rows_below(const UnitSlopes& slopes, const MonotoneMap& map);

/// Rows of the conditional table, whose slopes y are in units of `scale`. Both arguments must
/// outlive the result.
RowSource conditional_rows(const UnitSlopes& slopes, const ConditionalScale<double>& scale);

}  // namespace vndf::precompute
