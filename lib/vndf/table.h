// One table of quantiles and its lookup: linear or cubic between rows, monotone cubic along a row
// (Fritsch and Carlson 1980). A row is an increasing sequence of values in [0, 1]; the interpolant
// is increasing too, with a continuous derivative, so the sampled density has no steps.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <stdexcept>
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
  const int index = smaller(static_cast<int>(scaled), nodes - 2);
  return {index, scaled - static_cast<T>(index)};
}

/// Four neighbouring values of a row.
template <class T>
using Four = std::array<T, 4>;

/// Monotone cubic through the middle two of four equidistant increasing values. The tangents are
/// central differences, limited to three times either neighbouring secant: that is enough for
/// monotonicity, and inactive where the values are smooth on the scale of the nodes.
template <class T>
[[gnu::always_inline]] inline CubicPiece<T> monotone_piece(const Four<T>& w) {
  const T before = w[1] - w[0], secant = w[2] - w[1], after = w[3] - w[2];
  const auto tangent = [](T left, T right) {
    return larger(smaller(T(0.5) * (left + right), T(3) * smaller(left, right)), T(0));
  };
  const T m1 = tangent(before, secant), m2 = tangent(secant, after);
  const T c2 = T(3) * secant - T(2) * m1 - m2, c3 = m1 + m2 - T(2) * secant;
  return {w[1], m1, c2, c3};
}

/// The same at a fraction of the way from the second value to the third.
template <class T>
T monotone_cubic(const Four<T>& w, T fraction) {
  return monotone_piece(w).at(fraction);
}

/// Weights of Lagrange's cubic through nodes 0, 1, 2, 3 at `x`.
template <class T>
Four<T> lagrange_weights(T x) {
  const T x1 = x - T(1), x2 = x - T(2), x3 = x - T(3);
  return {x1 * x2 * x3 * T(-1.0 / 6), x * x2 * x3 * T(0.5), x * x1 * x3 * T(-0.5),
          x * x1 * x2 * T(1.0 / 6)};
}

/// How a table is interpolated from row to row.
enum class RowBlend {
  linear,  ///< between the two rows around
  cubic    ///< Lagrange's cubic through the four rows around, or the outermost four
};

/// Immutable quantile table, in single or double precision. Each row is stored with one extra value
/// before and after it, continuing it as a parabola, so that the lookup needs no case for the first
/// and last cell. A table of one row does not depend on the row coordinate.
class QuantileTable {
 public:
  QuantileTable() = default;

  /// `values` holds `rows` rows of `columns` values. Throws std::invalid_argument unless rows >= 1,
  /// but not 2 or 3 for a cubic blend, columns >= 3 and the sizes agree; the values themselves are
  /// judged by check().
  QuantileTable(std::size_t rows, std::size_t columns, const std::vector<float>& values,
                RowBlend blend = RowBlend::linear)
      : rows_(rows), columns_(columns), blend_(blend), single_(padded(values)) {}

  /// The same in double precision, with a copy in single precision for samplers of that.
  static QuantileTable with_double_values(std::size_t rows, std::size_t columns,
                                          const std::vector<double>& values,
                                          RowBlend blend = RowBlend::linear) {
    QuantileTable table(rows, columns, std::vector<float>(values.begin(), values.end()), blend);
    table.double_ = table.padded(values);
    return table;
  }

  std::size_t rows() const { return rows_; }
  std::size_t columns() const { return columns_; }
  RowBlend blend() const { return blend_; }
  bool in_double() const { return !double_.empty(); }
  /// The values of row `i`, `columns()` of them; in double precision only if in_double().
  template <class T = float>
  const T* row(std::size_t i) const {
    return values<T>().data() + i * (columns_ + 2) + 1;
  }

  /// The interpolated value at row and column coordinates in [0, 1]: in [0, 1], increasing in
  /// `column`, continuous in both.
  template <class T>
  T lookup(T row_coordinate, T column_coordinate) const {
    const Cell<T> c = cell_of(column_coordinate, node_columns_);
    // Blending the four values first and limiting after costs one cubic instead of several, and is
    // monotone for the same reason: a linear blend of increasing values is increasing, and a cubic
    // one is where the rows are smooth, which the builder sees to.
    const Four<T> w = std::is_same_v<T, double> && in_double()
                          ? blended(double_.data() + c.index, row_coordinate)
                          : blended(single_.data() + c.index, row_coordinate);
    return smaller(larger(monotone_cubic(w, c.fraction), T(0)), T(1));
  }

  /// lookup() with its derivative by the column coordinate, from the same values; the derivative is
  /// 0 where the value is held at 0 or 1.
  template <class T>
  WithDerivative<T> lookup_with_derivative(T row_coordinate, T column_coordinate) const {
    const Cell<T> c = cell_of(column_coordinate, node_columns_);
    const CubicPiece<T> piece = monotone_piece(taps(c.index, row_coordinate));
    const T w = piece.at(c.fraction);
    const T held = smaller(larger(w, T(0)), T(1));
    const T slope = static_cast<T>(columns_ - 1) * piece.derivative(c.fraction);
    return {held, w == held ? slope : T(0)};
  }

  /// Column coordinate at which lookup() gives `value`, to a few roundings of 1 over the
  /// derivative; the nearer end for a value outside the row, any one of the columns where the row
  /// is flat.
  template <class T>
  T inverse(T row_coordinate, T value) const {
    std::size_t low = 0, high = columns_ - 1;  // `value` lies between these two nodes
    while (high - low > 1) {
      const std::size_t middle = (low + high) / 2;
      (taps(middle, row_coordinate)[1] > value ? high : low) = middle;
    }
    const T fraction = monotone_piece(taps(low, row_coordinate)).inverse(value);
    return (static_cast<T>(low) + fraction) / static_cast<T>(columns_ - 1);
  }

 private:
  template <class V>
  const std::vector<V>& values() const {
    if constexpr (std::is_same_v<V, float>)
      return single_;
    else
      return double_;
  }

  template <class V>
  std::vector<V> padded(const std::vector<V>& values) const {
    const bool too_few = rows_ == 0 || (blend_ == RowBlend::cubic && rows_ > 1 && rows_ < 4);
    if (too_few || columns_ < 3 || values.size() / columns_ != rows_ ||
        values.size() % columns_ != 0)
      throw std::invalid_argument(
          "a quantile table needs 1 row, or 2 and 4 for a cubic blend, or more, of 3 values or "
          "more");
    std::vector<V> result;
    result.reserve(rows_ * (columns_ + 2));
    for (std::size_t i = 0; i < rows_; ++i) {
      const V* w = values.data() + i * columns_;
      const V* end = w + columns_ - 1;
      result.push_back(3 * w[0] - 3 * w[1] + w[2]);
      result.insert(result.end(), w, w + columns_);
      result.push_back(3 * end[0] - 3 * end[-1] + end[-2]);
    }
    return result;
  }

  /// The four values around cell `index` of the blended row, in the precision meant for T.
  template <class T>
  Four<T> taps(std::size_t index, T row_coordinate) const {
    return std::is_same_v<T, double> && in_double()
               ? blended(double_.data() + index, row_coordinate)
               : blended(single_.data() + index, row_coordinate);
  }

  /// The four values from `column` on, blended between rows.
  template <class V, class T>
  Four<T> blended(const V* column, T row_coordinate) const {
    if (node_rows_ == 1) return four<T>(column);
    const Cell<T> r = cell_of(row_coordinate, node_rows_);
    return blend_ == RowBlend::cubic ? blended_cubic(column, r) : blended_linear(column, r);
  }

  template <class T, class V>
  static Four<T> four(const V* p) {
    Four<T> w;
    for (std::size_t k = 0; k < 4; ++k) w[k] = static_cast<T>(p[k]);
    return w;
  }

  template <class V, class T>
  Four<T> blended_linear(const V* column, const Cell<T>& r) const {
    const V *a = column + r.index * stride_, *b = a + stride_;
    Four<T> w;
    for (std::size_t k = 0; k < 4; ++k)
      w[k] = static_cast<T>(a[k]) + r.fraction * (static_cast<T>(b[k]) - static_cast<T>(a[k]));
    return w;
  }

  template <class V, class T>
  Four<T> blended_cubic(const V* column, const Cell<T>& r) const {
    const int first = smaller(larger(r.index - 1, 0), node_rows_ - 4);
    const Four<T> l = lagrange_weights(static_cast<T>(r.index - first) + r.fraction);
    const V *a = column + first * stride_, *b = a + stride_, *c = b + stride_, *d = c + stride_;
    Four<T> w;
    for (std::size_t k = 0; k < 4; ++k)
      w[k] = (l[0] * static_cast<T>(a[k]) + l[1] * static_cast<T>(b[k])) +
             (l[2] * static_cast<T>(c[k]) + l[3] * static_cast<T>(d[k]));
    return w;
  }

  std::size_t rows_ = 0, columns_ = 0;
  // The same as integers that convert to and from floats in one instruction.
  int node_rows_ = static_cast<int>(rows_), node_columns_ = static_cast<int>(columns_);
  std::ptrdiff_t stride_ = static_cast<std::ptrdiff_t>(columns_) + 2;
  RowBlend blend_ = RowBlend::linear;
  std::vector<float> single_;
  std::vector<double> double_;
};

}  // namespace vndf
