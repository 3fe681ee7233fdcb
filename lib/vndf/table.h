// One table of quantiles and its lookup: linear between rows, monotone cubic along a row (Fritsch
// and Carlson 1980). A row is an increasing sequence of values in [0, 1]; the interpolant is
// increasing too, with a continuous derivative, so the sampled density has no steps. Between rows
// it stays so, for a mean of increasing cubics increases.
#pragma once

#include <algorithm>
#include <cstddef>
#include <type_traits>
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
template <class T>
std::vector<CubicNode<T>> nodes_of_row(const T* values, std::size_t count);

/// Immutable quantile table, in single or double precision.
class QuantileTable {
 public:
  QuantileTable() = default;

  /// `values` holds `rows` rows of `columns` values. Throws std::invalid_argument unless rows >= 2,
  /// columns >= kFewestColumns and the sizes agree; the values themselves are judged by check().
  QuantileTable(std::size_t rows, std::size_t columns, const std::vector<float>& values);

  /// The same in double precision, with a copy in single precision for samplers of that.
  static QuantileTable with_double_values(std::size_t rows, std::size_t columns,
                                          const std::vector<double>& values);

  std::size_t rows() const { return rows_; }
  std::size_t columns() const { return columns_; }
  bool in_double() const { return !double_.empty(); }
  /// The nodes of row `i`, `columns()` of them; in double precision only if in_double().
  template <class T = float>
  const CubicNode<T>* row(std::size_t i) const {
    return nodes<T>().data() + i * columns_;
  }
  /// The values of row `i` alone.
  template <class T = float>
  std::vector<T> row_values(std::size_t i) const {
    std::vector<T> values;
    values.reserve(columns_);
    for (std::size_t j = 0; j < columns_; ++j) values.push_back(row<T>(i)[j].value);
    return values;
  }

  /// The interpolated value at row and column coordinates in [0, 1]: in [0, 1], increasing in
  /// `column`, continuous in both.
  template <class T>
  T lookup(T row_coordinate, T column_coordinate) const {
    return lookup_with_derivative(row_coordinate, column_coordinate).value;
  }

  /// lookup() with its derivative by the column coordinate; 0 where the value is held at 0 or 1.
  template <class T>
  WithDerivative<T> lookup_with_derivative(T row_coordinate, T column_coordinate) const {
    const Cell<T> c = cell_of(column_coordinate, columns_);
    const CubicPiece<T> cubic = piece(cell_of(row_coordinate, rows_), c.index);
    const T w = cubic.at(c.fraction);
    const T held = std::clamp(w, T(0), T(1));
    const T slope = static_cast<T>(columns_ - 1) * cubic.derivative(c.fraction);
    return {held, w == held ? slope : T(0)};
  }

  /// Column coordinate at which lookup() gives `value`, to a few roundings of 1 over the
  /// derivative; the nearer end for a value outside the row, any one of the columns where the row
  /// is flat.
  template <class T>
  T inverse(T row_coordinate, T value) const {
    const Cell<T> r = cell_of(row_coordinate, rows_);
    std::size_t low = 0, high = columns_ - 1;  // `value` lies between these two nodes
    while (high - low > 1) {
      const std::size_t middle = (low + high) / 2;
      (piece(r, middle).c0 > value ? high : low) = middle;
    }
    const T fraction = piece(r, low).inverse(value);
    return (static_cast<T>(low) + fraction) / static_cast<T>(columns_ - 1);
  }

 private:
  template <class V>
  const std::vector<CubicNode<V>>& nodes() const {
    if constexpr (std::is_same_v<V, float>)
      return single_;
    else
      return double_;
  }

  template <class V>
  std::vector<CubicNode<V>> nodes_of(const std::vector<V>& values) const;

  /// The cubic between columns `index` and `index` + 1 at row `r`, in the precision meant for T.
  template <class T>
  CubicPiece<T> piece(const Cell<T>& r, std::size_t index) const {
    if constexpr (std::is_same_v<T, double>)
      if (in_double()) return blended_piece(row<double>(r.index) + index, r.fraction);
    return blended_piece(row<float>(r.index) + index, r.fraction);
  }

  /// The nodes of two rows are blended, not what becomes of them: one cubic instead of two.
  template <class V, class T>
  CubicPiece<T> blended_piece(const CubicNode<V>* left, T fraction) const {
    const auto blended = [fraction](const CubicNode<V>& low, const CubicNode<V>& high) {
      const T value = static_cast<T>(low.value), tangent = static_cast<T>(low.tangent);
      return CubicNode<T>{value + fraction * (static_cast<T>(high.value) - value),
                          tangent + fraction * (static_cast<T>(high.tangent) - tangent)};
    };
    const CubicNode<V>* above = left + columns_;
    return hermite_piece(blended(left[0], above[0]), blended(left[1], above[1]));
  }

  std::size_t rows_ = 0, columns_ = 0;
  std::vector<CubicNode<float>> single_;
  std::vector<CubicNode<double>> double_;
};

}  // namespace vndf
