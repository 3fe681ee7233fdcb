// The exact map for visible GGX slopes, slope_x from u1 and slope_y from u2, with which other
// samplers of GGX are compared. Everything is evaluated in double precision.
//
// Marginal distribution: with x = tan(psi), N V(x) of Heitz and d'Eon 2014 (supplemental 1, section
// 4.2) is (cos + sin(psi + theta)) / 2 and N is (1 + cos) / 2. Hence S = sin(psi + theta) is
// uniform on [-cos, 1]; it is the height on the spherical cap of ggx_caps.h.
//
// Conditional distribution: z = y / sqrt(1 + x^2) has the density 2 / (pi (1 + z^2)^2). With
// z = cot(beta / 2) each of the two tails beyond |z| has the mass q / 2 = (beta - sin(beta)) / (2
// pi), which is Kepler's equation at eccentricity 1.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "vndf/cubic_piece.h"
#include "vndf/reference/ggx.h"
#include "vndf/reference/smith.h"
#include "vndf/support/increasing_root.h"

namespace vndf {

/// The angle psi in [-90, 90] degrees of a slope tan(psi).
struct SlopeAngle {
  double sin, cos;
};

/// The angle psi at which the visible marginal CDF is u. The errors are those of GgxExactMethod.
inline SlopeAngle visible_ggx_angle(const Incidence<double>& wi, const Probability<double>& u) {
  if (u.u == 0) return {-1, 0};
  const double height = u.u * (1 + wi.cos);  // S + cos
  const double s = u.u < 0.5 ? height - wi.cos : 1 - u.complement * (1 + wi.cos);
  // 1 - S^2 = (1 - S) (1 + S), 1 - S = (1 - u) (1 + cos), 1 + S = sin^2 / (1 + cos) + u (1 + cos)
  const double c = std::sqrt(u.complement * (wi.sin * wi.sin + height * (1 + wi.cos)));
  const double sine = s * wi.cos - c * wi.sin;
  // cos(psi) = c cos + s sin, multiplied by its conjugate where the sum would cancel
  const double cosine =
      s < 0 ? height * (wi.cos - s) / (c * wi.cos - s * wi.sin) : c * wi.cos + s * wi.sin;
  return {sine, cosine};
}

/// beta - sin(beta) for beta in [0, pi], without cancellation.
inline double angle_minus_sine(double beta) {
  constexpr double kCancels = 1.5;
  if (beta > kCancels) return beta - std::sin(beta);
  // beta^3 / 3! (1 - beta^2 / (4 5) (1 - beta^2 / (6 7) (1 - ...))), to beta^25
  const double square = beta * beta;
  double sum = 1;
  for (int k = 24; k >= 4; k -= 2) sum = 1 - square / (k * (k + 1)) * sum;
  return square * beta / 6 * sum;
}

/// z = tan(gamma / 2) of the angle with gamma + sin(gamma) = pi v, for 0 <= v <= 1/2. It serves
/// near z = 0.
inline double conditional_ggx_middle(double v) {
  if (v == 0) return 0;
  const double mean = std::numbers::pi * v;
  const auto f = [mean](double gamma) {
    return WithDerivative<double>{gamma + std::sin(gamma) - mean, 1 + std::cos(gamma)};
  };
  return std::tan(support::increasing_root(f, 0, 2, mean / 2) / 2);
}

/// 1 / z = tan(beta / 2) of the angle with beta - sin(beta) = pi q, for 0 <= q <= 1/2. It serves in
/// the tails.
inline double conditional_ggx_tail(double q) {
  if (q == 0) return 0;
  const double mean = std::numbers::pi * q;
  const auto f = [mean](double beta) {
    const double sine = std::sin(beta / 2);
    return WithDerivative<double>{angle_minus_sine(beta) - mean, 2 * sine * sine};
  };
  return std::tan(support::increasing_root(f, 0, std::numbers::pi, std::cbrt(6 * mean)) / 2);
}

/// The Method (smith.h) of GgxExact.
struct GgxExactMethod {
  /// Largest |CDF - u| of both slopes for u in [1e-12, 1 - 1e-12] and theta from 0 to 90 degrees,
  /// in double, and in float at azimuth 0, where it is the rounding of wi and of the normal.
  static constexpr double kDoubleError = 1e-15, kFloatError = 2e-7;
  /// Largest relative error in double of the mass beyond a slope, for lower tails of 1e-12 or more.
  static constexpr double kTailError = 1e-12;

  template <class T>
  static HomogeneousSlope<T> sample_slope(const Incidence<T>& wi, const Probability<T>& u1,
                                          const Probability<T>& u2) {
    const SlopeAngle x = visible_ggx_angle(in_double(wi), in_double(u1));
    const auto folded = fold(in_double(u2));
    // z = y / sqrt(1 + x^2) is p / q, where q is the tangent in the tail, and sqrt(1 + x^2) is
    // 1 / x.cos.
    const bool tail = folded.p.complement <= 0.5;
    const double p = tail ? 1 : conditional_ggx_middle(folded.p.u);
    const double q = tail ? conditional_ggx_tail(folded.p.complement) : 1;
    return {static_cast<T>(x.sin * q), static_cast<T>(folded.sign * p), static_cast<T>(x.cos * q)};
  }
};

/// slope_x increases with u1 and slope_y with u2 in the frame of the stretched incident direction.
template <class T>
using GgxExact = VisibleSampler<T, GgxShape, GgxExactMethod>;

}  // namespace vndf
