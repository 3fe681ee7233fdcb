// Fills one table: places its rows, makes each of them, and joins them.
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
  /// Values in double precision instead of single.
  bool in_double = false;
};

/// A table with the knots of its rows.
struct PlacedTable {
  QuantileTable table;
  std::vector<RowKnot> knots = {};
};

/// The table of `source`, its rows placed where they err least. Rows where no sample lands repeat
/// the row before them.
PlacedTable fill_table(const RowSource& source, const TableLayout& layout,
                       const support::Workers& workers);

/// The table of a source whose rows are all the same: its row at base 0 repeated.
QuantileTable fill_with_one_row(const RowSource& source, const TableLayout& layout);

}  // namespace vndf::precompute
