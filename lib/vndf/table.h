// One table of quantiles and its lookup: linear or cubic between rows, monotone cubic along a row
// (Fritsch and Carlson 1980). A row is an increasing sequence of values in [0, 1]; the interpolant
// is increasing too, with a continuous derivative, so the sampled density has no steps. Tangents
// are made once, when the table is, and lie beside their values, where one load finds both.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <type_traits>
#include <vector>

#include "vndf/cubic_piece.h"
#include "vndf/select.h"

namespace vndf {

/// A position between two nodes: `index` and the fraction towards index + 1.
template <class T>
struct Cell {
  int index;
  T fraction;
};

/// The cell of `coordinate` in [0, 1] among `nodes` >= 2 equidistant nodes. Any other coordinate,
/// not a number included, goes to the nearer end.
template <class T>
Cell<T> cell_of(T coordinate, int nodes) {
  const T last = static_cast<T>(nodes - 1);
  const T scaled = smaller(larger(coordinate, T(0)) * last, last);
  const int index = static_cast<int>(smaller(scaled, last - T(1)));
  return {index, scaled - static_cast<T>(index)};
}

/// Four numbers that are worked on side by side.
template <class T>
using Four = std::array<T, 4>;

/// A node and the one after it.
template <class T, class V>
Four<T> two_nodes(const CubicNode<V>* left) {
  const CubicNode<V>& right = left[1];
  return {static_cast<T>(left->value), static_cast<T>(left->tangent), static_cast<T>(right.value),
          static_cast<T>(right.tangent)};
}

/// The cubic between two nodes, (value, tangent) of the left one, then of the right one.
template <class T>
CubicPiece<T> hermite_piece(const Four<T>& nodes) {
  return hermite_piece<T>({nodes[0], nodes[1]}, {nodes[2], nodes[3]});
}

/// Two nodes that are a cubic blend of rows, with tangents that keep the piece between them
/// increasing. They are not limited where the rows are smooth, which the builder sees to.
template <class T>
Four<T> with_limited_tangents(const Four<T>& nodes) {
  const auto& [v0, t0, v1, t1] = nodes;
  const T most = T(kSteepest) * (v1 - v0);
  return {v0, larger(smaller(t0, most), T(0)), v1, larger(smaller(t1, most), T(0))};
}

/// Weights of Lagrange's cubic through nodes -1, 0, 1, 2 at `x`.
template <class T>
Four<T> lagrange_weights(T x) {
  constexpr Four<T> c0{T(0), T(1), T(0), T(0)}, c1{T(-1.0 / 3), T(-0.5), T(1), T(-1.0 / 6)},
      c2{T(0.5), T(-1), T(0.5), T(0)}, c3{T(-1.0 / 6), T(0.5), T(-0.5), T(1.0 / 6)};
  Four<T> w;
  for (std::size_t k = 0; k < 4; ++k) w[k] = c0[k] + x * (c1[k] + x * (c2[k] + x * c3[k]));
  return w;
}

/// Four rows and their weights.
template <class T>
struct RowWeights {
  int first;
  Four<T> weights;
};

/// Lagrange's cubic among `rows` >= 4 equidistant rows: the four around a coordinate in [0, 1], or
/// the outermost four. Any other coordinate, not a number included, goes to the nearer end.
template <class T>
RowWeights<T> lagrange_rows(T coordinate, int rows) {
  const T last = static_cast<T>(rows - 1);
  const T scaled = smaller(larger(coordinate, T(0)) * last, last);
  const int second = static_cast<int>(larger(smaller(scaled, last - T(2)), T(1)));
  return {second - 1, lagrange_weights(scaled - static_cast<T>(second))};
}

/// How a table is interpolated from row to row.
enum class RowBlend {
  linear,  ///< between the two rows around
  cubic    ///< Lagrange's cubic through the four rows around, or the outermost four
};

/// How the tangent of a node follows from the values of its row.
enum class Tangents {
  three_points,     ///< of the parabola through the three nearest values
  five_points,      ///< of the quartic through the five nearest; in rows of fewer by three
  five_points_even  ///< the same in rows that go on evenly before their first value, as
                    ///< conditionals
};

/// The nodes of a row of `count` >= 3 values that increase. Tangents are >= 0 and at most three
/// times the difference to either neighbour: that is enough for monotonicity, between rows too that
/// are blended linearly, and inactive where the values are smooth on the scale of the nodes.
template <class T>
std::vector<CubicNode<T>> nodes_of_row(const T* values, std::size_t count, Tangents rule);

/// Immutable quantile table, in single or double precision. A table of one row does not depend on
/// the row coordinate.
class QuantileTable {
 public:
  QuantileTable() = default;

  /// `values` holds `rows` rows of `columns` values. Throws std::invalid_argument unless rows >= 1,
  /// but not 2 or 3 for a cubic blend, columns >= 3 and the sizes agree; the values themselves are
  /// judged by check().
  QuantileTable(std::size_t rows, std::size_t columns, const std::vector<float>& values,
                RowBlend blend = RowBlend::linear, Tangents tangents = Tangents::five_points);

  /// The same in double precision, with a copy in single precision for samplers of that.
  static QuantileTable with_double_values(std::size_t rows, std::size_t columns,
                                          const std::vector<double>& values,
                                          RowBlend blend = RowBlend::linear,
                                          Tangents tangents = Tangents::five_points);

  std::size_t rows() const { return rows_; }
  std::size_t columns() const { return columns_; }
  RowBlend blend() const { return blend_; }
  Tangents tangents() const { return tangents_; }
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
    const Cell<T> c = cell_of(column_coordinate, node_columns_);
    return smaller(larger(piece(row_coordinate, c.index).at(c.fraction), T(0)), T(1));
  }

  /// lookup() with its derivative by the column coordinate, from the same values; the derivative is
  /// 0 where the value is held at 0 or 1.
  template <class T>
  WithDerivative<T> lookup_with_derivative(T row_coordinate, T column_coordinate) const {
    const Cell<T> c = cell_of(column_coordinate, node_columns_);
    const CubicPiece<T> cubic = piece(row_coordinate, c.index);
    const T w = cubic.at(c.fraction);
    const T held = smaller(larger(w, T(0)), T(1));
    const T slope = static_cast<T>(columns_ - 1) * cubic.derivative(c.fraction);
    return {held, w == held ? slope : T(0)};
  }

  /// Column coordinate at which lookup() gives `value`, to a few roundings of 1 over the
  /// derivative; the nearer end for a value outside the row, any one of the columns where the row
  /// is flat.
  template <class T>
  T inverse(T row_coordinate, T value) const {
    int low = 0, high = node_columns_ - 1;  // `value` lies between these two nodes
    while (high - low > 1) {
      const int middle = (low + high) / 2;
      (piece(row_coordinate, middle).c0 > value ? high : low) = middle;
    }
    const T fraction = piece(row_coordinate, low).inverse(value);
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

  /// The cubic between columns `index` and `index` + 1 of the blended row, in the precision meant
  /// for T. The nodes are blended, not what becomes of them: one cubic instead of several.
  template <class T>
  CubicPiece<T> piece(T row_coordinate, int index) const {
    if constexpr (std::is_same_v<T, double>)
      if (in_double()) return blended(double_.data() + index, row_coordinate);
    return blended(single_.data() + index, row_coordinate);
  }

  template <class V, class T>
  CubicPiece<T> blended(const CubicNode<V>* left, T row_coordinate) const {
    if (node_rows_ == 1) return hermite_piece(two_nodes<T>(left));
    return blend_ == RowBlend::cubic ? blended_cubic(left, row_coordinate)
                                     : hermite_piece(blended_linear(left, row_coordinate));
  }

  template <class V, class T>
  Four<T> blended_linear(const CubicNode<V>* left, T row_coordinate) const {
    const Cell<T> r = cell_of(row_coordinate, node_rows_);
    const CubicNode<V>* row = left + r.index * stride_;
    const Four<T> a = two_nodes<T>(row), b = two_nodes<T>(row + stride_);
    Four<T> w;
    for (std::size_t k = 0; k < 4; ++k) w[k] = a[k] + r.fraction * (b[k] - a[k]);
    return w;
  }

  template <class V, class T>
  CubicPiece<T> blended_cubic(const CubicNode<V>* left, T row_coordinate) const {
    const RowWeights<T> r = lagrange_rows(row_coordinate, node_rows_);
    const CubicNode<V>* row = left + r.first * stride_;
    const Four<T> a = two_nodes<T>(row), b = two_nodes<T>(row + stride_),
                  c = two_nodes<T>(row + 2 * stride_), d = two_nodes<T>(row + 3 * stride_);
    const auto& [la, lb, lc, ld] = r.weights;
    Four<T> w;
    for (std::size_t k = 0; k < 4; ++k) w[k] = (la * a[k] + lb * b[k]) + (lc * c[k] + ld * d[k]);
    return hermite_piece(with_limited_tangents(w));
  }

  std::size_t rows_ = 0, columns_ = 0;
  // The same as integers that convert to and from floats in one instruction.
  int node_rows_ = static_cast<int>(rows_), node_columns_ = static_cast<int>(columns_);
  std::ptrdiff_t stride_ = static_cast<std::ptrdiff_t>(columns_);
  RowBlend blend_ = RowBlend::linear;
  Tangents tangents_ = Tangents::five_points;
  std::vector<CubicNode<float>> single_;
  std::vector<CubicNode<double>> double_;
};

}  // namespace vndf
