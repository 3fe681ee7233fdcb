// The coordinates of the two tables and their inverses, written once for the builder, the sampler
// and the certificate. Slopes are in units of the mean slope mu = E|X|, so that c = cot(theta) /
// mu.
//
// Everything rests on one bounded form of a slope x,
//
//   sigma = tau / (1 + tau),  tau = x + sqrt(1 + x^2),  so that  x = (sigma - 1/2) / d,
//   d = sigma (1 - sigma),  sqrt(1 + x^2) = (1/2 - d) / d.
//
// sigma runs from 0 (x = -infinity) over 1/2 (x = 0) to 1 (x = +infinity). Near 0 it is 1/(2|x|),
// so a float keeps full relative precision in the heavy tail, and decoding needs no transcendental.
//
//   marginal table     row    xi = sqrt(2 (1 - sigma(c))): 0 at normal incidence, 1 at grazing
//                      column t = a / (a + b), a = u1^(1/4), b = (1 - u1)^(1/4)
//                      value  sigma(x) / sigma(c): 0 and 1 at the ends of every row, so x <= c
//                      holds
//                             between rows too
//   conditional table  row    e = sqrt(|2 sigma(x) - 1|): 0 at x = 0, 1 at |x| = infinity
//                      column q^(1/4), q = 2 min(u2, 1 - u2): the half y <= 0, the other by
//                      symmetry value  2 sigma(y / sqrt(1 + x^2))
//
// The square roots of the row axes grade them where the quantile is not smooth (u ~ tan(theta) M at
// the pole, cusped densities at x = 0). The fourth roots of the column axes put 32 of 1024 nodes
// below u = 1e-6, where a power tail or a logarithmic one needs them; q = 1 is the middle of the
// distribution of y, where nothing happens.
#pragma once

#include <algorithm>
#include <cmath>

namespace vndf {

/// A slope as sigma in [0, 1], with its complement carried where it is known without cancellation.
template <class T>
struct BoundedSlope {
  T sigma, complement;

  /// sigma (1 - sigma): the common denominator of the slope and of sqrt(1 + slope^2).
  T denominator() const { return sigma * complement; }
  /// Numerator of the slope: slope = numerator() / denominator().
  T numerator() const { return sigma - T(0.5); }
  /// sqrt(1 + slope^2) = hypotenuse() / denominator().
  T hypotenuse() const { return T(0.5) - denominator(); }
  /// The slope itself; infinite at sigma = 0 and 1.
  T slope() const { return numerator() / denominator(); }
};

template <class T>
BoundedSlope<T> bounded_from_sigma(T sigma) {
  return {sigma, T(1) - sigma};
}

/// The bounded form of any slope, infinite ones included.
template <class T>
BoundedSlope<T> bounded_from_slope(T slope) {
  // For x < 0 the mirrored slope is coded and swapped: tau has no cancellation for x >= 0.
  const T tau = std::abs(slope) + std::hypot(T(1), slope);
  const T small = T(1) / (T(1) + tau);
  const T large = std::isinf(tau) ? T(1) : tau * small;
  return slope < T(0) ? BoundedSlope<T>{small, large} : BoundedSlope<T>{large, small};
}

/// The bounded form of the cotangent z / s of a direction with vertical part z >= 0 and horizontal
/// part s >= 0, not both zero. Maximum error: 4 roundings, at any angle from pole to horizon.
template <class T>
BoundedSlope<T> bounded_cotangent(T z, T s) {
  const T upper = z + std::sqrt(z * z + s * s);
  const T scale = T(1) / (upper + s);
  return {upper * scale, s * scale};
}

/// Row of the marginal table for the cotangent `c` of the (stretched) incident direction.
template <class T>
T marginal_row(const BoundedSlope<T>& c) {
  return std::sqrt(T(2) * c.complement);
}

/// Inverse of marginal_row.
template <class T>
BoundedSlope<T> marginal_row_inverse(T row) {
  const T complement = row * row / T(2);
  return {T(1) - complement, complement};
}

/// Row of the conditional table for the slope `x`; the same for x and -x.
template <class T>
T conditional_row(const BoundedSlope<T>& x) {
  return std::sqrt(std::abs(x.sigma - x.complement));
}

/// Inverse of conditional_row: the slope |x| >= 0.
template <class T>
BoundedSlope<T> conditional_row_inverse(T row) {
  const T square = row * row;
  return {(T(1) + square) / T(2), (T(1) - square) / T(2)};
}

/// A probability with its complement, so that neither end is lost to rounding.
template <class T>
struct Probability {
  T u, complement;
};

/// Brings `u` into [0, 1]; not a number becomes 0.
template <class T>
Probability<T> probability(T u) {
  const T inside = u > T(0) ? std::min(u, T(1)) : T(0);
  return {inside, T(1) - inside};
}

/// Column of the marginal table for u1.
template <class T>
T marginal_column(const Probability<T>& p) {
  const T a = std::sqrt(std::sqrt(p.u));
  const T b = std::sqrt(std::sqrt(p.complement));
  return a / (a + b);
}

/// Inverse of marginal_column.
template <class T>
Probability<T> marginal_column_inverse(T t) {
  const T a = (t * t) * (t * t);
  const T b = ((T(1) - t) * (T(1) - t)) * ((T(1) - t) * (T(1) - t));
  return {a / (a + b), b / (a + b)};
}

/// The conditional slope is symmetric: u2 is looked up as q = 2 min(u2, 1 - u2), the probability
/// that |y| is larger, and the sign of y.
template <class T>
struct FoldedProbability {
  T q, sign;
};

template <class T>
FoldedProbability<T> fold(const Probability<T>& u2) {
  return {T(2) * std::min(u2.u, u2.complement), u2.u < T(0.5) ? T(-1) : T(1)};
}

/// Column of the conditional table for the folded probability q.
template <class T>
T conditional_column(T q) {
  return std::sqrt(std::sqrt(q));
}

/// Inverse of conditional_column.
template <class T>
Probability<T> conditional_column_inverse(T t) {
  return {(t * t) * (t * t), (T(1) - t) * (T(1) + t) * (T(1) + t * t)};
}

}  // namespace vndf
