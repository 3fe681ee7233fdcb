// int f(m) dm over the upper hemisphere by the midpoint rule, for densities that jump; smooth ones
// have hemisphere_integral.h.
#pragma once

#include <cmath>
#include <numbers>

#include "vndf/vec.h"

namespace vndf::test {

/// The slope of m along the azimuth phi is alpha times r: dm = m.z^3 alpha_x alpha_y r dr dphi. The
/// midpoints are of t in (0, 1), r = t^2 / (1 - t)^2, finest at the centre, and of the azimuth.
template <class F>
double over_slopes(F f, const Alpha<double>& alpha) {
  constexpr int kRings = 600, kSpokes = 240;
  double sum = 0;
  for (int i = 0; i < kRings; ++i) {
    const double t = (i + 0.5) / kRings, r = t * t / (1 - t) / (1 - t);
    const double dr = 2 * t / ((1 - t) * (1 - t) * (1 - t)) / kRings;
    for (int j = 0; j < kSpokes; ++j) {
      const double phi = 2 * std::numbers::pi * (j + 0.5) / kSpokes;
      const double x = alpha.x * r * std::cos(phi), y = alpha.y * r * std::sin(phi);
      const double z = 1 / std::sqrt(1 + x * x + y * y);
      sum += f(Vec3<double>{-x * z, -y * z, z}) * z * z * z * r * dr;
    }
  }
  return sum * alpha.x * alpha.y * 2 * std::numbers::pi / kSpokes;
}

}  // namespace vndf::test
