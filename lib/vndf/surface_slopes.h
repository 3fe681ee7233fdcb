// The slopes of a surface in the numbers that people give, maps are reported with
// (distributions/slope_map.h) and files store. A sampler needs the RoughSurface that they make.
#pragma once

#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "vndf/rough_surface.h"
#include "vndf/vec.h"

namespace vndf {

/// Slopes along x and y in units of `alpha`, with a correlation about a mean slope. Valid: alpha
/// finite and > 0, correlation inside (-1, 1), mean finite; check() says so.
struct SurfaceSlopes {
  Alpha<double> alpha;
  double correlation = 0;
  Vec2<double> mean{0, 0};  ///< that of the facet (-mean.x, -mean.y, 1)

  /// The surface for samplers in precision T. It is computed in double precision, because
  /// 1 - correlation^2 loses its digits where the correlation is near 1.
  template <class T>
  RoughSurface<T> surface() const {
    return RoughSurface<T>(RoughSurface<double>::correlated(alpha, correlation, mean));
  }

  bool operator==(const SurfaceSlopes& o) const {
    return alpha.x == o.alpha.x && alpha.y == o.alpha.y && correlation == o.correlation &&
           mean.x == o.mean.x && mean.y == o.mean.y;
  }
};

/// The slopes of a surface of roughness `alpha` that was turned by `degrees` about z, from x
/// towards y. Half turns change nothing, and quarter turns exchange the roughness exactly. Where
/// one roughness is more than 1e7 times the other the correlation may round to 1, which check()
/// refuses.
inline SurfaceSlopes turned(const Alpha<double>& alpha, double degrees) {
  const double least = std::remainder(degrees, 180.0);  // from -90 to 90
  const bool quarter = std::abs(least) == 90;
  const double c = quarter ? 0 : std::cos(least * std::numbers::pi / 180);
  const double s = quarter ? 1 : std::sin(least * std::numbers::pi / 180);
  const Alpha<double> across{std::hypot(alpha.x * c, alpha.y * s),
                             std::hypot(alpha.x * s, alpha.y * c)};
  const double ratios =
      alpha.x / across.x * (alpha.x / across.y) - alpha.y / across.x * (alpha.y / across.y);
  return {across, ratios * c * s};
}

/// Returns the first rule that is broken, for a message, or nothing.
inline std::optional<std::string> check(const SurfaceSlopes& slopes) {
  const auto& [alpha, correlation, mean] = slopes;
  const auto is_roughness = [](double a) { return a > 0 && std::isfinite(a); };
  if (!is_roughness(alpha.x) || !is_roughness(alpha.y)) return "alpha must be finite and > 0";
  if (!(std::abs(correlation) < 1)) return "the correlation must be inside (-1, 1)";
  if (!std::isfinite(mean.x) || !std::isfinite(mean.y)) return "the mean slope must be finite";
  return {};
}

}  // namespace vndf
