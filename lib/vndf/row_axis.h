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
    for (std::size_t i = 1; i < knots.size(); ++i)
      rows_per_base_.push_back(
          static_cast<T>((knots[i].row - knots[i - 1].row) / (knots[i].base - knots[i - 1].base)));
  }

  /// Row coordinate at a base coordinate.
  T row(T base) const {
    if (bases_.empty()) return base;
    const std::size_t i = segment(bases_, base);
    return std::clamp(rows_[i] + (base - bases_[i]) * rows_per_base_[i], rows_[i], rows_[i + 1]);
  }
  /// Inverse of row().
  T base(T row) const {
    if (bases_.empty()) return row;
    const std::size_t i = segment(rows_, row);
    return std::clamp(bases_[i] + (row - rows_[i]) / rows_per_base_[i], bases_[i], bases_[i + 1]);
  }

 private:
  static std::size_t segment(const std::vector<T>& from, T x) {
    if (from.size() == 2) return 0;
    const auto above = std::upper_bound(from.begin() + 1, from.end() - 1, x);
    return static_cast<std::size_t>(above - from.begin()) - 1;
  }

  std::vector<T> bases_, rows_, rows_per_base_;
};

}  // namespace vndf
