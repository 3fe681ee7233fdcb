// One piece of a piecewise cubic, with its derivative, inverse and Hermite form. The rows of tables
// (table.h), the map of a marginal (monotone_map.h) and curves (log_curve.h) are made of them.
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

  /// Inverse of at(): f in [0, 1], the nearer end for a value outside the piece. Newton's method
  /// could leave [0, 1] or cycle, and is kept within a bracket that each step narrows.
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

/// A cubic through increasing values increases where no tangent is more than this times the rise
/// (Fritsch and Carlson 1980).
inline constexpr double kSteepest = 3;

/// A value and its derivative per node spacing, where two pieces meet.
template <class T>
struct CubicNode {
  T value, tangent;
};

/// The cubic between two nodes.
template <class T>
CubicPiece<T> hermite_piece(const CubicNode<T>& left, const CubicNode<T>& right) {
  const T secant = right.value - left.value;
  const T c3 = left.tangent + right.tangent - T(2) * secant;
  return {left.value, left.tangent, secant - left.tangent - c3, c3};
}

}  // namespace vndf
