// An increasing map of [0, 1] with an exact inverse: a rational quadratic spline (Gregory and
// Delbourgo 1982) through nodes equidistant in s, increasing for any tangents >= 0. Tables of a
// distribution that no simple coordinate fits keep s, and their slopes are decoded through it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace vndf {

/// Value of the map at a node and its derivative per node spacing, both >= 0.
struct MonotoneNode {
  double value, tangent;
};

template <class T>
class MonotoneMap {
 public:
  /// The identity.
  MonotoneMap() = default;
  /// At least two nodes, whose values begin at 0 and never decrease; or none: the identity.
  explicit MonotoneMap(const std::vector<MonotoneNode>& nodes) {
    for (const MonotoneNode& n : nodes)
      nodes_.push_back({static_cast<T>(n.value), static_cast<T>(n.tangent)});
  }

  bool identity() const { return nodes_.empty(); }

  /// The map at `s`; outside [0, 1] at the nearer end.
  T at(T s) const {
    if (identity()) return s;
    const T scaled = s > T(0) ? std::min(s * last(), last()) : T(0);
    const std::size_t k = std::min(static_cast<std::size_t>(scaled), nodes_.size() - 2);
    const T f = scaled - static_cast<T>(k), g = f * (T(1) - f);
    const Piece p = piece(k);
    if (!(p.rise > T(0))) return p.low;
    return p.low + p.rise * ((p.rise * f * f + p.tangent * g) / (p.rise + p.bend * g));
  }

  /// Inverse of at(): s with at(s) = value; the nearer end for a value outside the map's.
  T inverse(T value) const {
    if (identity()) return value;
    const auto above = std::upper_bound(nodes_.begin() + 1, nodes_.end() - 1, value,
                                        [](T v, const Node& n) { return v < n.value; });
    const auto k = static_cast<std::size_t>(above - nodes_.begin()) - 1;
    const Piece p = piece(k);
    const T y = std::clamp(value - p.low, T(0), p.rise);
    if (!(y > T(0))) return static_cast<T>(k) / last();
    // at(s) = value is a f^2 + b f = c; of the two roots the one in [0, 1], without cancellation.
    const T a = p.rise * (p.rise - p.tangent) + y * p.bend;
    const T b = p.rise * p.tangent - y * p.bend;
    const T c = p.rise * y;
    const T f = T(2) * c / (b + std::sqrt(std::max(T(0), b * b + T(4) * a * c)));
    return (static_cast<T>(k) + std::min(f, T(1))) / last();
  }

 private:
  struct Node {
    T value, tangent;
  };
  /// Between two nodes: value and tangent at the lower one, the rise to the upper, and how far the
  /// tangents are from the secant.
  struct Piece {
    T low, rise, tangent, bend;
  };

  T last() const { return static_cast<T>(nodes_.size() - 1); }

  Piece piece(std::size_t k) const {
    const Node &l = nodes_[k], &r = nodes_[k + 1];
    const T rise = r.value - l.value;
    return {l.value, rise, l.tangent, l.tangent + r.tangent - T(2) * rise};
  }

  std::vector<Node> nodes_;
};

}  // namespace vndf
