// Cells of an axis of the kernel, and the cubics that lie in them. The kernel finds a cell by its
// keys, the leading bits of a positive float, without a search. A cell is a run of such keys, as
// long as one cubic follows the function in it.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

#include "vndf/cubic_piece.h"

namespace vndf::baking {

/// The keys from `first` to `last` - 1, which are those of the places from `begin` to `end`.
struct AxisCell {
  std::uint32_t first, last;
  double begin, end;

  double width() const { return end - begin; }
};

/// The cells of one axis, in increasing order.
struct Axis {
  std::uint32_t shift = 0;
  std::vector<AxisCell> cells = {};
  /// Whether some cell has one key and still does not follow the function: more bits are needed.
  bool too_coarse = false;

  std::uint32_t first_key() const { return cells.front().first; }
  std::uint32_t count() const { return cells.back().last - cells.front().first; }
};

/// How far a place is shifted so that its key keeps `bits` bits of the mantissa.
constexpr std::uint32_t shift_of(int bits) {
  return static_cast<std::uint32_t>(23 - bits);
}
inline std::uint32_t key_of(double place, std::uint32_t shift) {
  return std::bit_cast<std::uint32_t>(static_cast<float>(place)) >> shift;
}
/// The least place that has this key.
inline double first_place(std::uint32_t key, std::uint32_t shift) {
  return std::bit_cast<float>(key << shift);
}

/// The cells from `begin` to `end`, with the key of `end`. Each is the longest run of keys on which
/// `good(begin, end)` holds, or one key where it holds on none. Because `good` is what takes the
/// time, a run is doubled while it holds and then bisected.
template <class Good>
Axis cells_between(double begin, double end, int bits, Good good) {
  Axis axis{shift_of(bits)};
  std::uint32_t key = key_of(begin, axis.shift);
  const std::uint32_t last = key_of(end, axis.shift) + 1;
  const auto place = [&](std::uint32_t k) {
    return std::clamp(first_place(k, axis.shift), begin, end);
  };
  const auto holds = [&](std::uint32_t run) { return good(place(key), place(key + run)); };
  while (key < last) {
    std::uint32_t low = 1, high = last - key + 1;  // `low` is taken, `high` is too long
    if (place(key) < place(key + 1) && !holds(1)) {
      axis.too_coarse = true;
      high = 2;
    }
    for (std::uint32_t run = 2; run < high; run *= 2) {
      if (holds(run))
        low = run;
      else
        high = run;
    }
    while (high - low > 1) {
      const std::uint32_t middle = low + (high - low) / 2;
      (holds(middle) ? low : high) = middle;
    }
    axis.cells.push_back({key, key + low, place(key), place(key + low)});
    key += low;
  }
  return axis;
}

/// A value with its derivative, where two cells meet.
using Node = WithDerivative<double>;

/// c0 + f (c1 + f (c2 + f c3)), f being a place less the beginning of its cell.
using Cubic = std::array<double, 4>;

inline double at(const Cubic& c, double f) {
  return c[0] + f * (c[1] + f * (c[2] + f * c[3]));
}

/// The cubic with the values and derivatives of `low` at 0 and of `high` at `width`.
inline Cubic hermite(const Node& low, const Node& high, double width) {
  const double secant = (high.value - low.value) / width;
  const double c3 = (low.derivative + high.derivative - 2 * secant) / (width * width);
  return {low.value, low.derivative, (secant - low.derivative) / width - c3 * width, c3};
}

/// The bound on derivatives with which a cubic between two nodes cannot turn back: each must lie
/// between 0 and this (Fritsch and Carlson 1980).
inline double steepest_derivative(const Node& low, const Node& high, double width) {
  return kSteepest * (high.value - low.value) / width;
}

/// `derivative` moved to the nearer end of the range from 0 to `steepest`, which may be negative.
inline double limited(double derivative, double steepest) {
  return std::clamp(derivative, std::min(steepest, 0.0), std::max(steepest, 0.0));
}

/// Whether the cubic between two nodes is sure to turn back nowhere.
inline bool is_monotone(const Node& low, const Node& high, double width) {
  const double steepest = steepest_derivative(low, high, width);
  return limited(low.derivative, steepest) == low.derivative &&
         limited(high.derivative, steepest) == high.derivative;
}

/// The cubic between two nodes, with their derivatives limited so that it turns back nowhere.
inline Cubic monotone_hermite(const Node& low, const Node& high, double width) {
  const double steepest = steepest_derivative(low, high, width);
  return hermite({low.value, limited(low.derivative, steepest)},
                 {high.value, limited(high.derivative, steepest)}, width);
}

/// Where across a cell of rows the four rows lie that a patch goes through, as parts of its width.
/// They are the extrema of the Chebyshev polynomial of degree 3: both ends, so that neighbours
/// meet, and two places that keep the error between all four small.
inline constexpr std::array<double, 4> kRowPlaces{0, 0.25, 0.75, 1};

/// The cubic through values at kRowPlaces of `width`, by Newton's divided differences.
inline Cubic through(const std::array<double, 4>& values, double width) {
  std::array<double, 4> d = values;
  for (std::size_t order = 1; order < 4; ++order)
    for (std::size_t i = 3; i >= order; --i)
      d[i] = (d[i] - d[i - 1]) / ((kRowPlaces[i] - kRowPlaces[i - order]) * width);
  Cubic c{d[3], 0, 0, 0};
  for (std::size_t k = 3; k-- > 0;) {
    for (std::size_t i = 3; i >= 1; --i) c[i] = c[i - 1] - kRowPlaces[k] * width * c[i];
    c[0] = d[k] - kRowPlaces[k] * width * c[0];
  }
  return c;
}

}  // namespace vndf::baking
