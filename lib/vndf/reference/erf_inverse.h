// Inverses of erf and erfc, which are the quantiles of a Gaussian slope of density
// exp(-y^2) / sqrt(pi). The standard library has none, and the samplers need no other library.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <type_traits>

namespace vndf {

/// Largest relative error of giles_erf_inverse() in double.
inline constexpr double kGilesError = 1.3e-7;
/// Largest w that giles_erf_inverse() accepts. A larger w does not occur in float.
inline constexpr double kGilesEnd = 16;

/// y with erf(y) = x, given w = -log(1 - x^2) <= kGilesEnd (Giles 2012, "Approximating the erfinv
/// function", the polynomials for single precision). Maximum error: kGilesError.
template <class T>
T giles_erf_inverse(T x, T w) {
  constexpr double kCentral[]{2.81022636e-08,  3.43273939e-07, -3.5233877e-06,
                              -4.39150654e-06, 0.00021858087,  -0.00125372503,
                              -0.00417768164,  0.246640727,    1.50140941};
  constexpr double kTail[]{-0.000200214257, 0.000100950558, 0.00134934322,
                           -0.00367342844,  0.00573950773,  -0.0076224613,
                           0.00943887047,   1.00167406,     2.83297682};
  const bool central = w < T(5);
  const T t = central ? w - T(2.5) : std::sqrt(w) - T(3);
  T sum = 0;
  for (const double coefficient : central ? kCentral : kTail)
    sum = sum * t + static_cast<T>(coefficient);
  return sum * x;
}

/// Largest relative error of erf_inverse() and erfc_inverse() in double.
inline constexpr double kErfInverseError = 1e-15;
/// Largest relative error of erf_inverse() in float.
inline constexpr double kErfInverseFloatError = 4e-7;

/// y with erf(y) = x for |x| <= 1/2. Maximum error: kErfInverseError.
inline double erf_inverse_central(double x) {
  const double y = giles_erf_inverse(x, -std::log((1 - x) * (1 + x)));
  // Halley's method triples the digits of Giles's polynomial.
  const double newton = (std::erf(y) - x) * std::exp(y * y) / (2 * std::numbers::inv_sqrtpi);
  return y - newton / (1 + y * newton);
}

/// y >= 0 with erfc(y) = q, which is infinite at q = 0; 0 for q >= 1. Maximum error:
/// kErfInverseError, hence 2 y^2 kErfInverseError of the mass erfc(y), relative.
inline double erfc_inverse(double q) {
  if (q >= 1) return 0;
  if (q <= 0) return std::numeric_limits<double>::infinity();
  if (q > 0.5) return erf_inverse_central(1 - q);
  // In the tail Newton's method on log(erfc), which is concave and nearly a parabola, doubles the
  // digits in each step. It needs 5 steps from the asymptotic form of erfc.
  constexpr int kSteps = 5;
  constexpr double kLastStep = 1e-9;
  const double w = -std::log(q * (2 - q));
  double y = w < kGilesEnd ? giles_erf_inverse(1 - q, w)
                           : std::sqrt(w - std::log(2 * std::sqrt(std::numbers::pi * w))) + 0.1;
  for (int k = 0; k < kSteps; ++k) {
    const double mass = std::erfc(y);
    const double rate = 2 * std::numbers::inv_sqrtpi * std::exp(-y * y) / mass;
    const double step = std::log(mass / q) / rate;
    y += step;
    if (std::abs(step) < kLastStep * y) break;
  }
  return y;
}

/// y with erf(y) = x, which is infinite at x = 1 and -1. Maximum error: kErfInverseError, in float
/// kErfInverseFloatError.
template <class T>
T erf_inverse(T x) {
  if (!(std::abs(x) < T(1))) return std::copysign(std::numeric_limits<T>::infinity(), x);
  if constexpr (std::is_same_v<T, float>)
    return giles_erf_inverse(x, -std::log((1 - x) * (1 + x)));
  else
    return std::abs(x) < T(0.5) ? erf_inverse_central(x)
                                : std::copysign(erfc_inverse(1 - std::abs(x)), x);
}

}  // namespace vndf
