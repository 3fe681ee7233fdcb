// An increasing map of [0, 1], through which the values of the marginal table are decoded:
// quantiles of slope x have cusps and corners, and in s, of which the map makes them, they are
// smooth. It is a cubic Hermite spline through nodes equidistant in s, whose tangents are limited
// so that it cannot turn back (Fritsch and Carlson 1980).
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "vndf/cubic_piece.h"
#include "vndf/select.h"

namespace vndf {

class MonotoneMap {
 public:
  /// Takes two nodes or more. Values begin at 0 and never decrease; tangents are >= 0 and at most
  /// kSteepest times the rise to either neighbour, which is enough for the map to increase.
  explicit MonotoneMap(const std::vector<CubicNode<double>>& nodes) {
    for (std::size_t k = 0; k + 1 < nodes.size(); ++k)
      pieces_.push_back(hermite_piece(nodes[k], nodes[k + 1]));
  }

  /// The map at `s`; outside [0, 1] at the nearer end.
  double at(double s) const { return at_with_derivative(s).value; }

  /// at() with its derivative by `s`: inside [0, 1] that of the piece, 0 only where the map is
  /// flat.
  WithDerivative<double> at_with_derivative(double s) const {
    const double scaled = smaller(larger(s, 0.0) * count(), count());
    const auto k = static_cast<std::size_t>(smaller(scaled, count() - 1));
    const double f = scaled - static_cast<double>(k);
    return {pieces_[k].at(f), count() * pieces_[k].derivative(f)};
  }

  /// Inverse of at(), to a few roundings of 1; the nearer end for a value outside the map's.
  double inverse(double value) const {
    const auto above =
        std::upper_bound(pieces_.begin() + 1, pieces_.end(), value,
                         [](double v, const CubicPiece<double>& p) { return v < p.c0; });
    const auto k = static_cast<std::size_t>(above - pieces_.begin()) - 1;
    return (static_cast<double>(k) + pieces_[k].inverse(value)) / count();
  }

 private:
  double count() const { return static_cast<double>(pieces_.size()); }

  std::vector<CubicPiece<double>> pieces_;
};

}  // namespace vndf
