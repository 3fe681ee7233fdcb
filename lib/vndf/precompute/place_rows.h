// Chooses where the rows of a table lie. The error of linear interpolation falls with the square of
// the number of rows in an interval, so rows are moved to where a table changes fast, until all
// intervals err by about as much.
#pragma once

#include <cstddef>
#include <vector>

#include "vndf/precompute/rows.h"
#include "vndf/row_axis.h"
#include "vndf/support/parallel.h"

namespace vndf::precompute {

/// Returns the knots of the axis of `rows` rows, or none where equidistant rows would err less than
/// three times as much: equidistant rows cost no search when they are read.
std::vector<RowKnot> place_rows(const RowSource& source, std::size_t rows,
                                const support::Workers& workers);

}  // namespace vndf::precompute
