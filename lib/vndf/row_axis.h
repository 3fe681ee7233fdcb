// Where the rows of a table lie. Rows must be crowded where a table changes fast: at the edge of a
// compact distribution, around a kink, at both scales of a mixture. The axis is a monotone
// piecewise linear map from the base coordinate of table_coordinates.h to the row coordinate, which
// is in [0, 1].
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

namespace vndf {

struct RowKnot {
  double base, row;
};

class RowAxis {
 public:
  /// Takes knots that increase in both coordinates, from row 0 to row 1. A base coordinate outside
  /// them goes to the nearer end. Without knots those from 0 to 1 are taken as they are, so that
  /// rows are equidistant.
  explicit RowAxis(std::vector<RowKnot> knots) : knots_(std::move(knots)) {}

  /// Row coordinate at a base coordinate.
  double row(double base) const { return along(&RowKnot::base, &RowKnot::row, base); }
  /// Inverse of row().
  double base(double row) const { return along(&RowKnot::row, &RowKnot::base, row); }

 private:
  /// The coordinate `to` on the straight lines between the knots, where the coordinate `from` is x.
  double along(double RowKnot::*from, double RowKnot::*to, double x) const {
    if (knots_.empty()) return std::clamp(x, 0.0, 1.0);
    const auto above =
        std::upper_bound(knots_.begin() + 1, knots_.end() - 1, x,
                         [from](double value, const RowKnot& k) { return value < k.*from; });
    const RowKnot &high = *above, &low = *(above - 1);
    const double fraction = (x - low.*from) / (high.*from - low.*from);
    return std::clamp(low.*to + fraction * (high.*to - low.*to), low.*to, high.*to);
  }

  std::vector<RowKnot> knots_;
};

}  // namespace vndf
