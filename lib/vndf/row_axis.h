// Where the rows of a table lie: a monotone piecewise linear map from the base coordinate of
// table_coordinates.h to the row coordinate, both in [0, 1]. It crowds rows where a table changes
// fast: at the edge of a compact distribution, around a kink, at both scales of a mixture.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace vndf {

struct RowKnot {
  double base, row;
};

template <class T>
class RowAxis {
 public:
  /// Rows equidistant in the base coordinate.
  RowAxis() = default;
  /// Knots that increase in both coordinates; the first row is 0 and the last 1. A base coordinate
  /// outside them goes to the nearer end. No knots: the identity.
  explicit RowAxis(const std::vector<RowKnot>& knots) {
    for (const RowKnot& k : knots) {
      bases_.push_back(static_cast<T>(k.base));
      rows_.push_back(static_cast<T>(k.row));
    }
  }

  /// Row coordinate at a base coordinate.
  T row(T base) const { return bases_.empty() ? base : interpolate(bases_, rows_, base); }
  /// Inverse of row().
  T base(T row) const { return bases_.empty() ? row : interpolate(rows_, bases_, row); }

 private:
  static T interpolate(const std::vector<T>& from, const std::vector<T>& to, T x) {
    const auto above = std::upper_bound(from.begin() + 1, from.end() - 1, x);
    const auto i = static_cast<std::size_t>(above - from.begin());
    const T fraction = std::clamp((x - from[i - 1]) / (from[i] - from[i - 1]), T(0), T(1));
    return to[i - 1] + fraction * (to[i] - to[i - 1]);
  }

  std::vector<T> bases_, rows_;
};

}  // namespace vndf
