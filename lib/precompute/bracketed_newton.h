// Root of a decreasing function within a bracket: Newton's method, with bisection wherever a step
// would leave the bracket. It always converges.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace vndf::precompute {

struct ValueAndSlope {
  double value, slope;
};

struct Bracket {
  double low, high;
};

/// x with f(x) = 0 for decreasing f that is >= 0 at bracket.low and <= 0 at bracket.high;
/// f(x) returns ValueAndSlope. Ends with a step below 1e-8 |x| or a few roundings of 1, whose error
/// is the square of it, or when the bracket has no number left inside. `guess` need not be inside
/// the bracket.
template <class F>
double bracketed_newton(F f, Bracket bracket, double guess) {
  constexpr double kResolution = 4 * std::numeric_limits<double>::epsilon();
  constexpr double kLastStep = 1e-8;
  const auto middle = [&] { return bracket.low + (bracket.high - bracket.low) / 2; };
  const auto inside = [&](double x) { return x > bracket.low && x < bracket.high; };
  double x = inside(guess) ? guess : middle();
  while (inside(x)) {
    const ValueAndSlope at = f(x);
    if (at.value == 0) return x;
    (at.value > 0 ? bracket.low : bracket.high) = x;
    const double step = -at.value / at.slope;
    // Newton's method squares the error: after a step this small, the next would be lost in
    // rounding.
    const double enough = std::max(kResolution, kLastStep * std::abs(x));
    if (std::abs(step) <= enough) return std::clamp(x + step, bracket.low, bracket.high);
    x = inside(x + step) ? x + step : middle();
  }
  return x;
}

}  // namespace vndf::precompute
