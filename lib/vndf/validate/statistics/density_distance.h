// Comparison of a density with the exact one at a normal that has been rounded. Where the density
// is steep it changes by more than any bound within the rounding, so the comparison is with the
// values that it takes nearby.
#pragma once

#include <algorithm>
#include <cmath>

#include "vndf/validate/exact/configuration.h"

namespace vndf::validate {

/// Densities are compared up to what they change by when the slope of the normal changes by this
/// factor, some roundings of a single-precision normal.
inline constexpr double kSlopeRounding = 5e-7;

/// The distance of `given` from the values that `exact` takes at the slopes of `wm`, whose distance
/// from the mean slope of `surface` is taken 1 -+ kSlopeRounding times (more on a surface which
/// ExactSurface::rounding() tells rounds more), relative to the largest value that `scale` takes
/// there: 0 where that is infinite, and not a number where `given` is none.
template <class Exact, class Scale>
double density_distance(double given, const Vec3<double>& wm, const ExactSurface& surface,
                        Exact exact, Scale scale) {
  const double x = surface.mean.x * wm.z, y = surface.mean.y * wm.z;
  const double rounding = kSlopeRounding * surface.rounding();
  const auto range = [&](auto f) {
    const auto at = [&](double s) {
      return f(Vec3<double>{(wm.x + x) * s - x, (wm.y + y) * s - y, wm.z});
    };
    return std::minmax({at(1), at(1 - rounding), at(1 + rounding)});
  };
  const auto [low, high] = range(exact);
  const double largest = range(scale).second;
  if (std::isnan(given)) return kUnknown;
  if (std::isinf(largest) || (given >= low && given <= high)) return 0;
  return std::max(low - given, given - high) / largest;
}

}  // namespace vndf::validate
