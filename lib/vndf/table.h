// One table of quantiles and its lookup: linear between rows, monotone cubic along a row (Fritsch
// and Carlson 1980). A row is an increasing sequence of values in [0, 1]. Its interpolant increases
// too, so that the map of a sampler can be inverted, and has a continuous derivative, so that the
// sampled density has no steps. Between rows both stay true, because a mean of increasing cubics
// increases.
//
// Lookups are in double precision, whatever that of the values, because rounding would err by as
// much as interpolation does.
#pragma once

#include <cstddef>
#include <vector>

#include "vndf/cubic_piece.h"
#include "vndf/select.h"

namespace vndf {

/// A position between two nodes: `index` and the fraction towards index + 1.
template <class T>
struct Cell {
  std::size_t index;
  T fraction;
};

/// The cell of `coordinate` in [0, 1] among `nodes` >= 2 equidistant nodes. Any other coordinate,
/// not a number included, goes to the nearer end.
template <class T>
Cell<T> cell_of(T coordinate, std::size_t nodes) {
  const T last = static_cast<T>(nodes - 1);
  const T scaled = smaller(larger(coordinate, T(0)) * last, last);
  const auto index = static_cast<std::size_t>(smaller(scaled, last - T(1)));
  return {index, scaled - static_cast<T>(index)};
}

/// Fewest columns of a table: tangents are made of five values.
inline constexpr std::size_t kFewestColumns = 5;

/// The nodes of a row of `count` >= kFewestColumns values that increase. A tangent is the
/// derivative of the quartic through the five values nearest to the node. It is >= 0 and at most
/// three times the difference to either neighbour: that is enough for monotonicity, and inactive
/// where the values are smooth on the scale of the nodes.
std::vector<CubicNode<double>> nodes_of_row(const double* values, std::size_t count);

/// Immutable quantile table, of values in single or double precision.
class QuantileTable {
 public:
  QuantileTable() = default;

  /// `values` holds `rows` rows of `columns` values. Throws std::invalid_argument unless rows >= 2,
  /// columns >= kFewestColumns and the sizes agree; check() (slope_tables.h) has the rules for the
  /// values.
  QuantileTable(std::size_t rows, std::size_t columns, const std::vector<float>& values);

  /// The same for values in double precision, which the table says of itself.
  static QuantileTable with_double_values(std::size_t rows, std::size_t columns,
                                          const std::vector<double>& values);

  std::size_t rows() const { return rows_; }
  std::size_t columns() const { return columns_; }
  bool in_double() const { return in_double_; }
  /// The nodes of row `i`, `columns()` of them.
  const CubicNode<double>* row(std::size_t i) const { return nodes_.data() + i * columns_; }
  /// The values of row `i` alone.
  std::vector<double> row_values(std::size_t i) const;

  /// The interpolated value at row and column coordinates in [0, 1]: in [0, 1], increasing in
  /// `column`, continuous in both.
  double lookup(double row, double column) const {
    return lookup_with_derivative(row, column).value;
  }

  /// lookup() with its derivative by the column coordinate; 0 where the value is clamped to 0 or 1.
  [[gnu::pure]] WithDerivative<double> lookup_with_derivative(double row, double column) const;

  /// Column coordinate at which lookup() gives `value`, to a few roundings of 1 over the
  /// derivative; the nearer end for a value outside the row, any one of the columns where the row
  /// is flat.
  double inverse(double row, double value) const;

 private:
  QuantileTable(std::size_t rows, std::size_t columns, const std::vector<double>& values,
                bool in_double);

  /// The cubic between columns `index` and `index` + 1 at row `r`.
  CubicPiece<double> piece(const Cell<double>& r, std::size_t index) const;

  std::size_t rows_ = 0, columns_ = 0;
  bool in_double_ = false;
  std::vector<CubicNode<double>> nodes_;
};

}  // namespace vndf
