// Fills one table: places its rows, makes each of them, and joins them.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "vndf/row_axis.h"
#include "vndf/support/parallel.h"
#include "vndf/table.h"
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
