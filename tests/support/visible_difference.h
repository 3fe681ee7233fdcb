// How far two distributions of slopes are apart, as a renderer sees them.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "vndf/precompute/marginal_distribution.h"

namespace vndf::test {

/// Largest difference of the visible marginal CDFs of `a` and `b` between the pole and the horizon.
inline double largest_difference(const precompute::UnitSlopes& a, const precompute::UnitSlopes& b) {
  double worst = 0;
  for (const double degrees : {0.0, 10.0, 45.0, 80.0, 89.0, 90.0}) {
    const double theta = degrees * std::numbers::pi / 180;
    const auto c = bounded_cotangent(degrees == 90 ? 0 : std::cos(theta), std::sin(theta));
    const precompute::MarginalDistribution va(a, c), vb(b, c);
    for (double x = -10; x < std::min(va.farthest(), 10.0); x += 0.05)
      worst = std::max(worst, std::abs(va.cdf(x).u - vb.cdf(x).u));
  }
  return worst;
}

}  // namespace vndf::test
