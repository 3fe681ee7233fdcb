// One piece of an increasing piecewise cubic, with its derivative and its inverse: what the rows of
// the tables (table.h) and the map of a marginal (monotone_map.h) are made of.
#pragma once

namespace vndf {

/// A value with its derivative by the argument it was taken at.
template <class T>
struct WithDerivative {
  T value, derivative;
};

/// c0 + f (c1 + f (c2 + f c3)), increasing for f in [0, 1].
template <class T>
struct CubicPiece {
  T c0, c1, c2, c3;

  T at(T f) const { return c0 + f * (c1 + f * (c2 + f * c3)); }

  T derivative(T f) const { return c1 + f * (T(2) * c2 + f * T(3) * c3); }

  /// f in [0, 1] with at(f) = value, the nearer end for a value outside the piece: Newton's method
  /// within a bracket that each step narrows.
  T inverse(T value) const {
    T low = T(0), high = T(1), f = T(0.5);
    if (!(value > c0)) return low;
    if (!(value < at(high))) return high;
    constexpr int kSteps = 64;
    for (int i = 0; i < kSteps && low < f && f < high; ++i) {
      const T excess = at(f) - value;
      (excess > T(0) ? high : low) = f;
      const T next = f - excess / derivative(f);
      if (next == f) break;
      f = next > low && next < high ? next : (low + high) / T(2);
    }
    return f;
  }
};

}  // namespace vndf
