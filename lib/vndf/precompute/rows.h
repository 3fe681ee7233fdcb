// The rows of the two tables: the quantiles of the visible slope x at one incidence, and of the
// slope y given x, as the values that table_coordinates.h defines.
#pragma once

#include <functional>
#include <vector>

#include "vndf/monotone_map.h"
#include "vndf/precompute/unit_slopes.h"
#include "vndf/table_coordinates.h"

namespace vndf::precompute {

/// A table whose rows can be made at any base coordinate.
struct RowSource {
  /// Values of the row at a base coordinate, at the columns whose probabilities are `u`; empty
  /// where no sample lands.
  std::function<std::vector<double>(double base, const std::vector<Probability<double>>& u)> row;
  /// Inverse of the column coordinate.
  Probability<double> (*column_inverse)(double);
  /// Largest base coordinate that matters: rows run from 0 to it.
  double end = 1;
  /// Base coordinates, in (0, end), at which the table has a kink.
  std::vector<double> breaks = {};
};

/// Both refer to their arguments, which must outlive them: `map` is that of marginal_map.h, `scale`
/// the unit of the slopes y.
RowSource marginal_rows(const UnitSlopes& slopes, const MonotoneMap& map);
RowSource conditional_rows(const UnitSlopes& slopes, const ConditionalScale<double>& scale);

}  // namespace vndf::precompute
