// Chooses where the rows of a table lie, so that linear interpolation between them errs by about as
// much everywhere: the error of an interval of base coordinates falls with the square of its rows.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "precompute/parallel.h"
#include "vndf/row_axis.h"
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

/// Knots for `rows` rows; none where equidistant rows would err less than three times as much.
std::vector<RowKnot> place_rows(const RowSource& source, std::size_t rows, const Workers& workers);

}  // namespace vndf::precompute
