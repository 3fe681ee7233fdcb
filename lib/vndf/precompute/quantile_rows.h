// The rows of the two tables: the quantiles of the visible slope x at one incidence, and of the
// slope y given x, as the values that table_coordinates.h defines.
#pragma once

#include "vndf/monotone_map.h"
#include "vndf/precompute/fill_table.h"
#include "vndf/precompute/unit_slopes.h"
#include "vndf/table_coordinates.h"

namespace vndf::precompute {

/// Both refer to their arguments, which must outlive them: `map` is that of marginal_map.h, `scale`
/// the unit of the slopes y.
RowSource marginal_rows(const UnitSlopes& slopes, const MonotoneMap& map);
RowSource conditional_rows(const UnitSlopes& slopes, const ConditionalScale<double>& scale);

}  // namespace vndf::precompute
