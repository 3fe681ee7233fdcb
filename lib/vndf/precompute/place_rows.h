// Chooses where the rows of a table lie, so that linear interpolation between them errs by about as
// much everywhere: the error of an interval of base coordinates falls with the square of its rows.
#pragma once

#include <cstddef>
#include <vector>

#include "vndf/precompute/rows.h"
#include "vndf/row_axis.h"
#include "vndf/support/parallel.h"

namespace vndf::precompute {

/// Knots for `rows` rows; none where equidistant rows would err less than three times as much.
std::vector<RowKnot> place_rows(const RowSource& source, std::size_t rows,
                                const support::Workers& workers);

}  // namespace vndf::precompute
