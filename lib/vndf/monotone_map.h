// An increasing map of [0, 1]: a cubic Hermite spline through nodes equidistant in s, whose
// tangents are limited so that it cannot turn back (Fritsch and Carlson 1980). The marginal table
// keeps s, and its slopes are decoded through the map.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "vndf/cubic_piece.h"
#include "vndf/select.h"

namespace vndf {

template <class T>
class MonotoneMap {
 public:
  /// At least two nodes. Values begin at 0 and never decrease; tangents are >= 0 and at most
  /// kSteepest times the rise to either neighbour, which is enough for the map to increase.
  explicit MonotoneMap(const std::vector<CubicNode<double>>& nodes) {
    for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
      const auto piece = hermite_piece(nodes[k], nodes[k + 1]);
      pieces_.push_back({static_cast<T>(piece.c0), static_cast<T>(piece.c1),
                         static_cast<T>(piece.c2), static_cast<T>(piece.c3)});
    }
    count_ = static_cast<T>(pieces_.size());
  }

  /// The map at `s`; outside [0, 1] at the nearer end.
  T at(T s) const { return at_with_derivative(s).value; }

  /// at() with its derivative by `s`: inside [0, 1] that of the piece, 0 only where the map is
  /// flat.
  WithDerivative<T> at_with_derivative(T s) const {
    const T scaled = smaller(larger(s, T(0)) * count_, count_);
    const auto k = static_cast<std::size_t>(smaller(scaled, count_ - T(1)));
    const T f = scaled - static_cast<T>(k);
    return {pieces_[k].at(f), count_ * pieces_[k].derivative(f)};
  }

  /// Inverse of at(), to a few roundings of 1; the nearer end for a value outside the map's.
  T inverse(T value) const {
    const auto above = std::upper_bound(pieces_.begin() + 1, pieces_.end(), value,
                                        [](T v, const CubicPiece<T>& p) { return v < p.c0; });
    const auto k = static_cast<std::size_t>(above - pieces_.begin()) - 1;
    return (static_cast<T>(k) + pieces_[k].inverse(value)) / count_;
  }

 private:
  std::vector<CubicPiece<T>> pieces_;
  T count_;
};

}  // namespace vndf
