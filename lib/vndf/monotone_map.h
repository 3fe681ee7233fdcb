// An increasing map of [0, 1]: a cubic Hermite spline through nodes equidistant in s, whose
// tangents are limited so that it cannot turn back (Fritsch and Carlson 1980). Tables of a
// distribution that no simple coordinate fits keep s, and their slopes are decoded through it.
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
  /// The identity.
  MonotoneMap() = default;
  /// At least two nodes, or none: the identity. Values begin at 0 and never decrease; tangents are
  /// >= 0 and at most kSteepest times the rise to either neighbour, which is enough for the map to
  /// increase.
  explicit MonotoneMap(const std::vector<CubicNode<double>>& nodes) {
    for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
      const auto piece = hermite_piece(nodes[k], nodes[k + 1]);
      pieces_.push_back({static_cast<T>(piece.c0), static_cast<T>(piece.c1),
                         static_cast<T>(piece.c2), static_cast<T>(piece.c3)});
    }
    count_ = static_cast<T>(pieces_.size());
  }

  bool identity() const { return pieces_.empty(); }

  /// The map at `s`; outside [0, 1] at the nearer end.
  T at(T s) const {
    if (identity()) return s;
    const T scaled = smaller(larger(s, T(0)) * count_, count_);
    const int k = static_cast<int>(smaller(scaled, count_ - T(1)));
    return pieces_[static_cast<std::size_t>(k)].at(scaled - static_cast<T>(k));
  }

  /// at() with its derivative by `s`: inside [0, 1] that of the piece, 0 only where the map is
  /// flat.
  WithDerivative<T> at_with_derivative(T s) const {
    if (identity()) return {s, T(1)};
    const T scaled = smaller(larger(s, T(0)) * count_, count_);
    const int k = static_cast<int>(smaller(scaled, count_ - T(1)));
    const Piece& piece = pieces_[static_cast<std::size_t>(k)];
    const T f = scaled - static_cast<T>(k);
    return {piece.at(f), count_ * piece.derivative(f)};
  }

  /// Inverse of at(), to a few roundings of 1; the nearer end for a value outside the map's.
  T inverse(T value) const {
    if (identity()) return value;
    const auto above = std::upper_bound(pieces_.begin() + 1, pieces_.end(), value,
                                        [](T v, const Piece& p) { return v < p.c0; });
    const auto k = static_cast<std::size_t>(above - pieces_.begin()) - 1;
    return (static_cast<T>(k) + pieces_[k].inverse(value)) / count_;
  }

  /// Cubics between nodes; none for the identity.
  std::size_t pieces() const { return pieces_.size(); }
  /// Coefficients c0, c1, c2, c3 of each piece in its fraction f, four a piece.
  const T* coefficients() const { return identity() ? nullptr : &pieces_.front().c0; }

 private:
  using Piece = CubicPiece<T>;
  static_assert(sizeof(Piece) == 4 * sizeof(T), "coefficients() reads pieces as one array");

  std::vector<Piece> pieces_;
  T count_ = T(0);
};

}  // namespace vndf
