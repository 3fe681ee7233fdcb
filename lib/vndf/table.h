// One table of quantiles and its lookup: linear between rows, monotone cubic along a row
// (Fritsch and Carlson 1980). A row is an increasing sequence of values in [0, 1]; the interpolant
// is increasing too, with a continuous derivative, so the sampled density has no steps.
#pragma once

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <vector>

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
  const T scaled = coordinate > T(0) ? std::min(coordinate * last, last) : T(0);
  const std::size_t index = std::min(static_cast<std::size_t>(scaled), nodes - 2);
  return {index, scaled - static_cast<T>(index)};
}

/// Monotone cubic through the middle two of four equidistant increasing values. The tangents are
/// central differences, limited to three times either neighbouring secant: that is enough for
/// monotonicity, and inactive where the values are smooth on the scale of the nodes.
template <class T>
T monotone_cubic(T w0, T w1, T w2, T w3, T fraction) {
  const T before = w1 - w0, secant = w2 - w1, after = w3 - w2;
  const auto tangent = [](T left, T right) {
    return std::max(T(0), std::min(T(0.5) * (left + right), T(3) * std::min(left, right)));
  };
  const T m1 = tangent(before, secant), m2 = tangent(secant, after);
  const T c2 = T(3) * secant - T(2) * m1 - m2, c3 = m1 + m2 - T(2) * secant;
  return w1 + fraction * (m1 + fraction * (c2 + fraction * c3));
}

/// Immutable quantile table. Each row is stored with one extra value before and after it,
/// continuing it as a parabola, so that the lookup needs no case for the first and last cell.
class QuantileTable {
 public:
  QuantileTable() = default;

  /// `values` holds `rows` rows of `columns` values. Throws std::invalid_argument unless
  /// rows >= 2, columns >= 3 and the sizes agree; the values themselves are judged by check().
  QuantileTable(std::size_t rows, std::size_t columns, const std::vector<float>& values)
      : rows_(rows), columns_(columns) {
    if (rows < 2 || columns < 3 || values.size() / columns != rows || values.size() % columns != 0)
      throw std::invalid_argument("a quantile table needs at least 2 rows of at least 3 values");
    padded_.reserve(rows * (columns + 2));
    for (std::size_t i = 0; i < rows; ++i) {
      const float* w = values.data() + i * columns;
      const float* end = w + columns - 1;
      padded_.push_back(3 * w[0] - 3 * w[1] + w[2]);
      padded_.insert(padded_.end(), w, w + columns);
      padded_.push_back(3 * end[0] - 3 * end[-1] + end[-2]);
    }
  }

  std::size_t rows() const { return rows_; }
  std::size_t columns() const { return columns_; }
  /// The values of row `i`, `columns()` of them.
  const float* row(std::size_t i) const { return padded_.data() + i * (columns_ + 2) + 1; }

  /// The interpolated value at row and column coordinates in [0, 1]: in [0, 1], increasing in
  /// `column`, continuous in both.
  template <class T>
  T lookup(T row_coordinate, T column_coordinate) const {
    const Cell<T> r = cell_of(row_coordinate, rows_);
    const Cell<T> c = cell_of(column_coordinate, columns_);
    const float* lower = row(r.index) + c.index - 1;
    const float* upper = lower + columns_ + 2;
    // Blending the four values first and limiting after costs one cubic instead of two and is
    // monotone for the same reason: the blend of increasing values is increasing.
    const auto blend = [&](int k) {
      return static_cast<T>(lower[k]) +
             r.fraction * (static_cast<T>(upper[k]) - static_cast<T>(lower[k]));
    };
    const T w = monotone_cubic(blend(0), blend(1), blend(2), blend(3), c.fraction);
    return std::min(std::max(w, T(0)), T(1));
  }

 private:
  std::size_t rows_ = 0, columns_ = 0;
  std::vector<float> padded_;
};

}  // namespace vndf
