// Numbers over the cells of a rectangle: the data of one picture.
#pragma once

#include <cstddef>
#include <vector>

namespace vndf::validate {

/// Numbers row by row from the lower edge, each row from the left.
struct Grid {
  std::size_t columns = 0, rows = 0;
  std::vector<double> values;

  Grid() = default;
  Grid(std::size_t columns_, std::size_t rows_, double value = 0)
      : columns(columns_), rows(rows_), values(columns_ * rows_, value) {}

  /// The number of a cell.
  double& at(std::size_t column, std::size_t row) { return values[row * columns + column]; }
  double at(std::size_t column, std::size_t row) const { return values[row * columns + column]; }
};

/// The largest number that is above 0, or 0 if there is none. What is not a number counts as
/// nothing.
inline double largest(const Grid& grid) {
  double most = 0;
  for (const double v : grid.values)
    if (v > most) most = v;
  return most;
}

}  // namespace vndf::validate
