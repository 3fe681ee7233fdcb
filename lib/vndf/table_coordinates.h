// The coordinates of the two tables, each beside its inverse, written once for the builder, the
// sampler and the certificate. They are the same for every distribution; pair_coordinates.h adds
// what is made for one. Slopes are in units of the mean slope mu = E|X|, so that c = cot(theta) /
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
//   marginal table     base   sqrt(2 (1 - sigma(c))) above the horizon, 2 - sqrt(2 sigma(c)) below
//                             it: 0 at normal incidence, 1 at grazing, 2 straight from below, as
//                             far as anything is visible
//                      column t = a / (a + b), a = u1^(1/4), b = (1 - u1)^(1/4)
//                      value  s with map(s) = sigma(x) / scale, a map made for the distribution
//                             (monotone_map.h): its own quantile function over the same columns,
//                             through which the quantiles of all angles are smooth. The scale is
//                             1 above the horizon. From below only slopes x < c < 0 are visible,
//                             far in the tail, and with scale = 2 sigma(c) each row ends at s of
//                             slope 0 and keeps its digits.
//   conditional table  base   sqrt(|2 sigma(x) - 1|): 0 at x = 0, 1 at |x| = infinity
//                      column t = b / (a + b), a = s^(1/2), b = (1 - s)^(1/2), s = q^(1/2),
//                             q = 1 - |2 u2 - 1|: the half y >= 0, the other by symmetry
//                      value  2 sigma(y / scale) - 1, scale = sqrt(max(0, A + B x^2)): with the A
//                             and B that make all rows the same where that can be, as for Beckmann
//                             and Student-T slopes, GGX among them; with A = R^2 and B = -1 where
//                             no slope is larger than R
//   rows               a RowAxis maps the base coordinate to the row; it is the identity where rows
//                      equidistant in it serve well
//
// The square roots of the base coordinates grade them where the quantile is not smooth (u ~
// tan(theta) M at the pole, cusped densities at x = 0). The fourth roots of the column axes put 32
// of 1024 nodes below u = 1e-6, where a power tail or a logarithmic one needs them.
#pragma once

#include <algorithm>
#include <cmath>

#include "vndf/select.h"

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

/// The slope of a given sigma.
template <class T>
BoundedSlope<T> bounded_from_sigma(T sigma) {
  return {sigma, T(1) - sigma};
}

/// The same slope in double precision, in which tables are looked up.
template <class T>
BoundedSlope<double> widened(const BoundedSlope<T>& x) {
  return {double{x.sigma}, double{x.complement}};
}

/// Returns min(x, edge). Both fields are clamped separately because, near 1, sigma is less precise
/// than its complement.
template <class T>
BoundedSlope<T> clamp_below(const BoundedSlope<T>& edge, const BoundedSlope<T>& x) {
  return {smaller(x.sigma, edge.sigma), larger(x.complement, edge.complement)};
}

/// The bounded form of any slope, infinite ones included.
template <class T>
BoundedSlope<T> bounded_from_slope(T slope) {
  // tau has no cancellation for x >= 0. For x < 0 the fields of the mirrored slope are swapped.
  const T tau = std::abs(slope) + std::hypot(T(1), slope);
  const T small = T(1) / (T(1) + tau);
  const T large = std::isinf(tau) ? T(1) : tau * small;
  return slope < T(0) ? BoundedSlope<T>{small, large} : BoundedSlope<T>{large, small};
}

/// The bounded form of the slope -x.
template <class T>
BoundedSlope<T> mirrored(const BoundedSlope<T>& x) {
  return {x.complement, x.sigma};
}

/// The bounded form of the cotangent z / s of a direction with vertical part z and horizontal part
/// s >= 0, not both zero. Maximum error: 4 roundings of either field, at any angle.
/// `square` is s * s, for a caller that knows it before s.
template <class T>
BoundedSlope<T> bounded_cotangent(T z, T s, T square) {
  const T upper = std::abs(z) + std::sqrt(z * z + square);
  const T scale = T(1) / (upper + s);
  const BoundedSlope<T> above{upper * scale, s * scale};
  return z < T(0) ? mirrored(above) : above;
}
template <class T>
BoundedSlope<T> bounded_cotangent(T z, T s) {
  return bounded_cotangent(z, s, s * s);
}

/// The bounded form of the slope x / w, w >= 0, not both zero: infinite at w = 0.
template <class T>
BoundedSlope<T> bounded_from_fraction(T x, T w) {
  return bounded_cotangent(x, w);
}

/// Base coordinate of the marginal table for the cotangent `c` of the (stretched) incident
/// direction.
template <class T>
T marginal_base(const BoundedSlope<T>& c) {
  const T from_pole = std::sqrt(T(2) * smaller(c.sigma, c.complement));
  return c.sigma < c.complement ? T(2) - from_pole : from_pole;
}

/// Inverse of marginal_base.
template <class T>
BoundedSlope<T> marginal_base_inverse(T base) {
  const T from_pole = base > T(1) ? T(2) - base : base;
  const T least = from_pole * from_pole / T(2);
  const BoundedSlope<T> above{T(1) - least, least};
  return base > T(1) ? mirrored(above) : above;
}

/// What sigma of slopes x is divided by in the marginal table at the cotangent `c`: 1 above the
/// horizon, less below.
template <class T>
T marginal_scale(const BoundedSlope<T>& c) {
  return smaller(T(2) * c.sigma, T(1));
}

/// Base coordinate of the conditional table for the slope `x`; the same for x and -x. With
/// x = n / d, |2 sigma(x) - 1| = |n| / (d + sqrt(d^2 + n^2)).
template <class T>
T conditional_base(const BoundedSlope<T>& x) {
  const T n = std::abs(x.numerator()), d = x.denominator();
  return std::sqrt(n / (d + std::sqrt(d * d + n * n)));
}

/// Inverse of conditional_base: the slope |x| >= 0, infinite at base 1.
template <class T>
T conditional_base_inverse(T base) {
  const T square = base * base;
  return T(2) * square / ((T(1) - square) * (T(1) + square));
}

/// A probability with its complement, so that neither end is lost to rounding.
template <class T>
struct Probability {
  T u, complement;
};

/// The same probability in double precision, in which tables are looked up.
template <class T>
Probability<double> widened(const Probability<T>& p) {
  return {double{p.u}, double{p.complement}};
}

/// Brings `u` into [0, 1]; not a number becomes 0.
template <class T>
Probability<T> probability(T u) {
  const T inside = smaller(larger(u, T(0)), T(1));
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

/// du1 / dt of marginal_column_inverse(): u / (1 - u) = (t / (1 - t))^4 gives 4 u (1 - u) / (t (1 -
/// t)), here without the 0 / 0 at the ends, where it is 0.
template <class T>
T marginal_column_rate(T t) {
  const T product = t * (T(1) - t), a = t * t, b = (T(1) - t) * (T(1) - t);
  const T sum = a * a + b * b;
  return T(4) * (product * product * product) / (sum * sum);
}

/// The conditional slope is symmetric: |y| is below its quantile at |2 u2 - 1|, whose complement is
/// q = 2 min(u2, 1 - u2), and has the sign of u2 - 1/2.
template <class T>
struct FoldedProbability {
  Probability<T> p;
  T sign;
};

template <class T>
FoldedProbability<T> fold(const Probability<T>& u2) {
  return {{std::abs(u2.u - u2.complement), smaller(u2.u + u2.u, u2.complement + u2.complement)},
          std::copysign(T(1), u2.u - T(0.5))};
}

/// Inverse of fold().
template <class T>
T unfold(const FoldedProbability<T>& folded) {
  const T half = folded.p.complement / T(2);
  return folded.sign < T(0) ? half : T(1) - half;
}

/// Column of the conditional table for the probability p of a smaller |y|.
template <class T>
T conditional_column(const Probability<T>& p) {
  const T s = std::sqrt(p.complement);
  // b^2 = 1 - s = (1 - s^2) / (1 + s), so b / (a + b) is multiplied by the root of 1 + s.
  const T a = std::sqrt(s + s * s), b = std::sqrt(p.u);
  return b / (a + b);
}

/// Inverse of conditional_column.
template <class T>
Probability<T> conditional_column_inverse(T t) {
  const T a = (T(1) - t) * (T(1) - t), b = t * t;
  const T s = a / (a + b);
  return {b / (a + b) * (T(1) + s), s * s};
}

/// dp / dt of conditional_column_inverse(): 0 at both ends, as 4 t and 4 (1 - t)^3.
template <class T>
T conditional_column_rate(T t) {
  const T a = (T(1) - t) * (T(1) - t), b = t * t;
  const T sum = a + b;
  return T(4) * a * (t * (T(1) - t)) / (sum * sum * sum);
}

/// A slope >= 0 as value of the conditional table, v = 2 sigma - 1.
template <class T>
T conditional_value(const BoundedSlope<T>& y) {
  return y.sigma - y.complement;
}

/// A slope as a fraction, infinite at denominator 0.
template <class T>
struct SlopeFraction {
  T numerator, denominator;

  T slope() const { return numerator / denominator; }
};

/// Inverse of conditional_value.
template <class T>
SlopeFraction<T> conditional_value_inverse(T v) {
  return {T(2) * v, (T(1) - v) * (T(1) + v)};
}

/// Scale of the conditional slope: sqrt(max(0, A + B x^2)), A = `constant` and B = `quadratic`.
template <class T>
struct ConditionalScale {
  T constant = T(1), quadratic = T(1);

  /// The scale at the slope x, times x.denominator.
  T at(const SlopeFraction<T>& x) const {
    const T a = std::sqrt(constant) * x.denominator;
    const T b = std::sqrt(std::abs(quadratic)) * x.numerator;
    if (quadratic >= T(0)) return std::sqrt(a * a + b * b);
    return std::sqrt(std::max(T(0), (a - b) * (a + b)));  // as a product it keeps digits at the rim
  }
};

}  // namespace vndf
