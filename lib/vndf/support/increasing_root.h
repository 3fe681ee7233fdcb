// Root of an increasing function within a bracket: Newton's method, with bisection wherever a step
// would leave the bracket. It always converges.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace vndf::support {

/// The step that ends the search: Newton's method squares the error, so that after a step this
/// small the next would be lost in rounding.
struct LastStep {
  double relative = 1e-9;
  /// Counts where the root is near 0.
  double absolute = std::numeric_limits<double>::min();
};

/// x in [low, high] with f(x) = 0, for increasing f with f(low) <= 0 <= f(high); `f(x)` is
/// its value and its derivative (WithDerivative). Ends with a step below `last`, whose error is the
/// square of it, or when the bracket has no number left inside. `guess` need not be inside the
/// bracket.
template <class F>
double increasing_root(F f, double low, double high, double guess, const LastStep& last = {}) {
  const auto inside = [&](double x) { return x > low && x < high; };
  double x = inside(guess) ? guess : low + (high - low) / 2;
  while (inside(x)) {
    const auto at = f(x);
    if (at.value == 0) return x;
    (at.value < 0 ? low : high) = x;
    const double step = -at.value / at.derivative;
    if (std::abs(step) <= std::max(last.relative * std::abs(x), last.absolute))
      return std::clamp(x + step, low, high);
    x = inside(x + step) ? x + step : low + (high - low) / 2;
  }
  return x;
}

}  // namespace vndf::support
