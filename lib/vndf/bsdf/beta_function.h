// Euler's beta function B(a, b) = Gamma(a) Gamma(b) / Gamma(a + b) for a, b >= 1 of any size, which
// correlated masking needs in transmission (masking.h). We do not use the standard library's
// because it may throw, nor its gamma functions because their quotient overflows for large
// arguments.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

namespace vndf {

/// Largest absolute error of stirling_excess(), in double precision.
inline constexpr double kStirlingError = 2.1e-11;

/// Largest relative error of beta_function() in double precision where the result is above 1e-100.
/// Nearly all of it comes from the three calls of stirling_excess().
inline constexpr double kBetaError = 2e-11;
/// Largest relative error of beta_function() in single precision, in roundings for each unit of
/// 1 + |log B|.
inline constexpr double kBetaRoundings = 4;

/// Stirling's correction log Gamma(z) - [(z - 1/2) log z - z + log(2 pi) / 2] for z >= 1, which is
/// about 1 / (12 z) for large z. The product of z and the correction is a polynomial in 1 / z,
/// interpolated at the 11 Chebyshev points of [0, 1]. Maximum error: kStirlingError.
template <class T>
T stirling_excess(T z) noexcept {
  constexpr std::array<double, 11> kCoefficients{
      0.083333333313136752,   4.9426779039910245e-9,  -0.0027779866240762459,
      3.5850536311209985e-6,  0.00076088592160902547, 0.00018031625832222506,
      -0.0012253873076370116, 0.0013878823244933471,  -0.00084424769952025234,
      0.00028539153986797316, -4.231093084914139e-5};
  const T w = T(1) / z;
  T sum = T(0);
  for (auto c = kCoefficients.rbegin(); c != kCoefficients.rend(); ++c)
    sum = sum * w + static_cast<T>(*c);
  return sum * w;
}

/// B(a, b) for finite a, b >= 1; 0 where it is below the range of T. Maximum error: kBetaError in
/// double and kBetaRoundings in single precision.
template <class T>
T beta_function(T a, T b) noexcept {
  // Stirling's formula for the three gammas. Its powers are gathered so that none is large:
  // a^a / (a + b)^a = exp(-a log(1 + b / a)).
  const T excess = stirling_excess(a) + stirling_excess(b) - stirling_excess(a + b);
  const T powers = a * std::log1p(b / a) + b * std::log1p(a / b);
  const T root = std::sqrt(T(2) * std::numbers::pi_v<T> * (T(1) / a + T(1) / b));
  return root * std::exp(excess - powers);
}

}  // namespace vndf
