// Root of a decreasing function within a bracket: that of its negative, increasing_root.h.
#pragma once

#include <limits>

#include "vndf/support/increasing_root.h"

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
  const auto negative = [&f](double x) {
    const ValueAndSlope at = f(x);
    return support::ValueAndDerivative{-at.value, -at.slope};
  };
  return support::increasing_root(
      negative, bracket.low, bracket.high, guess,
      {.relative = 1e-8, .absolute = 4 * std::numeric_limits<double>::epsilon()});
}

}  // namespace vndf::precompute
