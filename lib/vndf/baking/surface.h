// What a kernel follows and how nearly: the quantile functions of a pair as surfaces over rows and
// q = min(u, 1 - u), the axis of columns, and the errors that count as none.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>

#include "vndf/baking/cells.h"
#include "vndf/baking/pair_slopes.h"
#include "vndf/cubic_piece.h"

namespace vndf::baking {

// Tails are followed to the first part of their mass down to this probability, and to the second
// below it, where they are seldom seen but values must not run away.
inline constexpr double kTailError = 0.04, kLeastTail = 0x1p-21, kLeastTailError = 0.5;
// Differences below these roundings of a value count as none.
inline constexpr double kRounding = 0x1p-22;
/// The column axis: places p of probabilities q = min(u, 1 - u), or their mirrors in the middle.
struct Columns {
  bool roots;
  double offset;  ///< of roots
  int octaves;    ///< places above one half are this power of two larger, and so are mirrors
  bool half = false, mirrored = false;

  double least() const { return roots ? offset + 0x1p-12 : 0x1p-25; }
  double most() const { return half ? span() / 2 : roots ? 1 + offset : 0.5; }
  /// What a place and its mirror add up to; not less than the least place and the most do.
  double span() const { return roots ? 1 + 2 * offset + 0x1p-12 : 0.5 + 0x1p-24; }
  double probability(double place) const {
    const double p = mirrored ? span() - place : place;
    if (!roots) return std::min(p, 0.5);
    return std::min((p - offset) * (p - offset) / 2, 0.5);
  }
  /// dq / dp.
  double rate(double place) const {
    if (!roots) return mirrored ? -1 : 1;
    return mirrored ? -(span() - place - offset) : place - offset;
  }
  /// The half of it below the middle, or above.
  Columns halved(bool above) const { return {roots, offset, octaves, true, above}; }
};
// The least place above one half, 2^-25 of p, is to have another key than 1/2 below it.
inline constexpr Columns kByProbability{false, 0, 25}, kByRoot{true, 0x1p-8, 9};

/// Whether values are near enough to those of a quantile function.
struct Criterion {
  double tolerance;  ///< in u

  bool accepts(double value, const Node& exact, double q) const {
    const double difference = std::abs(value - exact.value);
    const double error = difference / std::abs(exact.derivative);
    const double tail = (q < kLeastTail ? kLeastTailError : kTailError) * q;
    return error <= std::min(tolerance, tail) || difference <= kRounding * std::abs(exact.value);
  }
};

/// A quantile function over rows and q: of (g, u1) or of (place of slope x, q).
struct Surface {
  /// What stands for a row: it is made once for many q.
  std::function<double(double place)> row;
  std::function<Node(double row, double q)> at;
};

/// s of a place |s - s0|.
inline double s_at(const PairSlopes& slopes, double place, bool upper) {
  return upper ? slopes.middle_s() + place : slopes.middle_s() - place;
}

/// The root that the map has at a place |s - s0| of one half, and its derivative by the place.
inline Node map_node(const PairSlopes& slopes, double place, bool upper) {
  const Node root = slopes.map(s_at(slopes, place, upper));
  return {root.value, upper ? root.derivative : -root.derivative};
}

inline Surface marginal_surface(const PairSlopes& slopes, bool upper) {
  return {[&slopes](double g) { return slopes.direction_row(g); },
          [&slopes, upper](double row, double q) { return slopes.marginal(row, q, upper); }};
}
/// Over the places |s - s0| of one half.
inline Surface conditional_surface(const PairSlopes& slopes, bool upper) {
  return {[&slopes, upper](double place) { return slopes.slope_at(s_at(slopes, place, upper)); },
          // The same row is asked for many q in a row.
          [&slopes, last = -1.0, row = PairSlopes::ConditionalRow{}](double x, double q) mutable {
            if (x != last) {
              row = slopes.conditional_row(x);
              last = x;
            }
            return slopes.conditional(row, q);
          }};
}

inline Node node_at(const Surface& surface, const Columns& columns, double row, double p) {
  const Node node = surface.at(row, columns.probability(p));
  return {node.value, node.derivative * columns.rate(p)};
}

/// The cubic between two nodes, with derivatives that keep it from turning back.
inline Cubic limited_hermite(const Node& low, const Node& high, double width) {
  const double most = kSteepest * (high.value - low.value) / width;
  const auto limited = [most](double derivative) {
    return std::clamp(derivative, std::min(most, 0.0), std::max(most, 0.0));
  };
  return hermite({low.value, limited(low.derivative)}, {high.value, limited(high.derivative)},
                 width);
}

}  // namespace vndf::baking
