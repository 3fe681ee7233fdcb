// The slopes of a surface in the numbers that people give, maps are reported with
// (distributions/slope_map.h) and files store. A sampler needs the RoughSurface that they make.
#pragma once

#include <optional>
#include <string>
#include <string_view>

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
SurfaceSlopes turned(const Alpha<double>& alpha, double degrees);

/// Returns the first rule that is broken, for a message, or nothing.
std::optional<std::string> check(const SurfaceSlopes& slopes);

/// The form that files hold: alpha.x, alpha.y, correlation, mean.x and mean.y with a blank between
/// them, each the shortest decimal that reads back as the same number.
std::string text_of(const SurfaceSlopes& slopes);

/// Inverse of text_of(). Returns nothing for a text that is not five numbers with a blank between
/// them, or whose numbers break a rule of check(). Allocates nothing for the text of a surface.
std::optional<SurfaceSlopes> surface_slopes_of(std::string_view text);

}  // namespace vndf
