// Fills one table: places its rows, computes each of them, and joins them.
#pragma once

#include <cstddef>
#include <vector>

#include "vndf/precompute/rows.h"
#include "vndf/row_axis.h"
#include "vndf/support/parallel.h"
#include "vndf/table.h"

namespace vndf::precompute {

struct TableLayout {
  std::size_t rows = 1024, columns = 1024;
  /// Whether values are kept in double precision instead of single.
  bool in_double = false;
};

/// A table with the knots of the axis on which its rows lie.
struct PlacedTable {
  QuantileTable table;
  std::vector<RowKnot> knots = {};
};

/// Fills the table of `source`, with its rows where they err least (place_rows.h). Rows at which no
/// sample lands repeat the row before them.
PlacedTable fill_table(const RowSource& source, const TableLayout& layout,
                       const support::Workers& workers);

/// Fills one table of `source`, up to base coordinate 1, and of `beyond`, whose base coordinates
/// are 1 larger, with layout.rows rows of each: those that it would have alone. At 1 both have the
/// same row, which is in the table once.
PlacedTable fill_table(const RowSource& source, const RowSource& beyond, const TableLayout& layout,
                       const support::Workers& workers);

/// Fills the table of a source whose rows are all equal with its row at base coordinate 0.
QuantileTable fill_with_one_row(const RowSource& source, const TableLayout& layout);

}  // namespace vndf::precompute
