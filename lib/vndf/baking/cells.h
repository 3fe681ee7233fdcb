// Cells of an axis of the kernel: runs of keys, the leading bits of a positive float, each as long
// as the function on it is followed well enough.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

namespace vndf::baking {

/// Keys first to last - 1, over places from begin to end.
struct AxisCell {
  std::uint32_t first, last;
  double begin, end;

  double width() const { return end - begin; }
};

/// The cells of one axis, in increasing order.
struct Axis {
  std::uint32_t shift = 0;
  std::vector<AxisCell> cells = {};
  /// Whether a cell of one key is still worse than was asked for.
  bool too_coarse = false;

  std::uint32_t first_key() const { return cells.front().first; }
  std::uint32_t count() const { return cells.back().last - cells.front().first; }
};

/// The keys of `bits` bits of the mantissa.
constexpr std::uint32_t shift_of(int bits) {
  return static_cast<std::uint32_t>(23 - bits);
}
inline std::uint32_t key_of(double place, std::uint32_t shift) {
  return std::bit_cast<std::uint32_t>(static_cast<float>(place)) >> shift;
}
inline double first_place(std::uint32_t key, std::uint32_t shift) {
  return std::bit_cast<float>(key << shift);
}

/// Cells from `begin` to `end`, the key of `end` included, each the longest run of keys on which
/// `good(begin, end)` holds, or one key where it holds on none. Runs are found by doubling and then
/// halving, so that few are looked at.
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
    std::uint32_t low = 1, high = last - key + 1;  // runs that hold, or are taken; that do not
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

/// A value and its derivative.
struct Node {
  double value, derivative;
};

/// c0 + f (c1 + f (c2 + f c3)).
using Cubic = std::array<double, 4>;

inline double at(const Cubic& c, double f) {
  return c[0] + f * (c[1] + f * (c[2] + f * c[3]));
}

/// The cubic with these values and derivatives at 0 and at `width`.
inline Cubic hermite(const Node& low, const Node& high, double width) {
  const double secant = (high.value - low.value) / width;
  const double c3 = (low.derivative + high.derivative - 2 * secant) / (width * width);
  return {low.value, low.derivative, (secant - low.derivative) / width - c3 * width, c3};
}

/// Where across a cell of rows the four rows lie that a patch goes through, as parts of its width:
/// its ends, so that neighbours meet, and the places inside that keep the error between them least.
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
