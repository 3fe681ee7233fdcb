// What a kernel follows and how closely: the two quantile functions of a pair as surfaces over rows
// and q = min(u, 1 - u), the axis of columns, and the errors that count as none.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "vndf/baking/cells.h"
#include "vndf/baking/pair_slopes.h"

namespace vndf::baking {

// How far u may be from the exact one in a tail, as a part of q: within the tolerance alone the
// mass of a tail could change many times. Half of kTailError takes up to 18 % more bytes
// (Beckmann), and more than twice of it saves 5 % at most. Below kLeastTail few samples land, but
// values must not run away.
inline constexpr double kTailError = 0.04, kLeastTail = 0x1p-21, kLeastTailError = 0.5;
// Differences of this part of a value count as none, since coefficients are in single precision and
// a sum of four of them is rounded about as much.
inline constexpr double kRounding = 0x1p-22;

/// The axis of columns: the place p of a probability q = min(u, 1 - u). Where the conditional has
/// rows its axis is halved, and the half near u2 = 1/2 has mirrored places, which are small there.
struct Columns {
  bool roots;     ///< whether p is sqrt(2 q) + offset; else it is q
  double offset;  ///< that of roots
  int octaves;    ///< by how many powers of two places above one half, and mirrors, are larger
  bool half = false, mirrored = false;

  double least() const { return roots ? offset + 0x1p-12 : 0x1p-25; }
  double most() const { return half ? span() / 2 : roots ? 1 + offset : 0.5; }
  /// What a place and its mirror add up to: not less than the sum of the least place and the most,
  /// so that no mirror is before the first place.
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
  /// The half below the middle of the axis or, mirrored, the half above it.
  Columns halved(bool above) const { return {roots, offset, octaves, true, above}; }
};
// Both have more octaves than the axis of one half, so that no two halves share a key: places run
// from 2^-25 to 1/2, and from 2^-8 to 1 + 2^-8.
inline constexpr Columns kByProbability{false, 0, 25}, kByRoot{true, 0x1p-8, 9};

/// How near a value must be to that of a quantile function.
struct Criterion {
  double tolerance;  ///< in u
  /// Where values rise by less than this part from one end of a cell to the other, their
  /// derivatives are not asked for: the values have no digits to tell them.
  double least_rise = 0;

  /// Whether `value` stands for `exact`, the value and derivative at q: the difference in u is that
  /// of the values over the derivative.
  bool accepts(double value, const Node& exact, double q) const {
    const double difference = std::abs(value - exact.value);
    const double error = difference / std::abs(exact.derivative);
    const double tail = (q < kLeastTail ? kLeastTailError : kTailError) * q;
    return error <= std::min(tolerance, tail) || difference <= kRounding * std::abs(exact.value);
  }
};

/// A tolerance as criterion of directions below the horizon. They may see slopes that differ by a
/// few roundings only. Without a least rise a disk takes a third more bytes below the horizon;
/// 2^-18 and 2^-12 change nothing.
inline Criterion criterion_below(double tolerance) {
  return {tolerance, 0x1p-15};
}

/// A quantile function over the places of rows and q.
struct Surface {
  /// What at() takes for the place of a row, because many q are asked for one row.
  std::function<double(double place)> row;
  std::function<Node(double row, double q)> at;
};

/// s of the place |s - s0| in one half, s0 being that of slope 0.
inline double s_at(const PairSlopes& slopes, double place, bool upper) {
  return upper ? slopes.middle_s() + place : slopes.middle_s() - place;
}

/// The root of sigma at the place |s - s0| of one half, with its derivative by the place.
inline Node map_node(const PairSlopes& slopes, double place, bool upper) {
  const Node root = slopes.map(s_at(slopes, place, upper));
  return {root.value, upper ? root.derivative : -root.derivative};
}

/// What stands for slope x (PairSlopes::marginal) over g and q, in one half of u1.
inline Surface marginal_surface(const PairSlopes& slopes, bool upper, bool below) {
  return {[&slopes, below](double g) { return slopes.direction_row(g, below); },
          [&slopes, upper, below](double row, double q) {
            return below ? slopes.marginal_below(row, q, upper) : slopes.marginal(row, q, upper);
          }};
}
/// Slope y over places of slope x, which `slope_of` returns, and q.
template <class SlopeOf>
Surface conditional_surface_over(const PairSlopes& slopes, SlopeOf slope_of) {
  return {slope_of,
          // Keeps the row of the last x, for it is asked for many q one after the other.
          [&slopes, last = -1.0, row = PairSlopes::ConditionalRow{}](double x, double q) mutable {
            if (x != last) {
              row = slopes.conditional_row(x);
              last = x;
            }
            return slopes.conditional(row, q);
          }};
}
/// Slope y over the places |s - s0| of one half, and q.
inline Surface conditional_surface(const PairSlopes& slopes, bool upper) {
  return conditional_surface_over(slopes, [&slopes, upper](double place) {
    return slopes.slope_at(s_at(slopes, place, upper));
  });
}
/// The root of sigma at slope 0.
inline constexpr double kMiddleRoot = std::numbers::sqrt2 / 2;
/// Slope y over the places kMiddleRoot - root of slopes x < 0, and q.
inline Surface steep_surface(const PairSlopes& slopes) {
  return conditional_surface_over(slopes, [](double place) {
    const double root = kMiddleRoot - place, sigma = root * root;
    return std::max(0.5 - sigma, 0.0) / (sigma * (1 - sigma));
  });
}

/// The node of a surface at the place `p` of a column.
inline Node node_at(const Surface& surface, const Columns& columns, double row, double p) {
  const Node node = surface.at(row, columns.probability(p));
  return {node.value, node.derivative * columns.rate(p)};
}

}  // namespace vndf::baking
