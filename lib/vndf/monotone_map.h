// An increasing map of [0, 1]: a cubic Hermite spline through nodes equidistant in s, whose
// tangents are limited so that it cannot turn back (Fritsch and Carlson 1980). Tables of a
// distribution that no simple coordinate fits keep s, and their slopes are decoded through it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "vndf/select.h"

namespace vndf {

/// Value of the map at a node and its derivative per node spacing, both >= 0; the derivative is at
/// most kSteepest times the rise to either neighbour, which is enough for the map to increase.
struct MonotoneNode {
  double value, tangent;
};
inline constexpr double kSteepest = 3;

template <class T>
class MonotoneMap {
 public:
  /// The identity.
  MonotoneMap() = default;
  /// At least two nodes, whose values begin at 0 and never decrease; or none: the identity.
  explicit MonotoneMap(const std::vector<MonotoneNode>& nodes) {
    for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
      const MonotoneNode &l = nodes[k], &r = nodes[k + 1];
      const double rise = r.value - l.value;
      pieces_.push_back({static_cast<T>(l.value), static_cast<T>(l.tangent),
                         static_cast<T>(3 * rise - 2 * l.tangent - r.tangent),
                         static_cast<T>(l.tangent + r.tangent - 2 * rise)});
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

  /// Inverse of at(), to a few roundings of 1; the nearer end for a value outside the map's.
  T inverse(T value) const {
    if (identity()) return value;
    const auto above = std::upper_bound(pieces_.begin() + 1, pieces_.end(), value,
                                        [](T v, const Piece& p) { return v < p.c0; });
    const auto k = static_cast<std::size_t>(above - pieces_.begin()) - 1;
    return (static_cast<T>(k) + pieces_[k].inverse(value)) / count_;
  }

 private:
  /// c0 + f (c1 + f (c2 + f c3)), increasing for f in [0, 1].
  struct Piece {
    T c0, c1, c2, c3;

    T at(T f) const { return c0 + f * (c1 + f * (c2 + f * c3)); }

    /// Newton's method within a bracket that each step narrows.
    T inverse(T value) const {
      T low = T(0), high = T(1), f = T(0.5);
      if (!(value > c0)) return low;
      if (!(value < at(high))) return high;
      constexpr int kSteps = 64;
      for (int i = 0; i < kSteps && low < f && f < high; ++i) {
        const T excess = at(f) - value;
        (excess > T(0) ? high : low) = f;
        const T next = f - excess / (c1 + f * (T(2) * c2 + f * T(3) * c3));
        if (next == f) break;
        f = next > low && next < high ? next : (low + high) / T(2);
      }
      return f;
    }
  };

  std::vector<Piece> pieces_;
  T count_ = T(0);
};

}  // namespace vndf
