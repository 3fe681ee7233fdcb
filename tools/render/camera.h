// A pinhole camera, and the rays through its image.
#pragma once

#include <cmath>
#include <numbers>

#include "render/frame.h"
#include "render/ray_tracer.h"

namespace vndf::render {

struct Camera {
  Vector position, target;
  float degrees = 40;  ///< the angle of view from the lower to the upper edge

  /// The ray through the point (x, y) of the image, both from 0 at the upper left to 1; `aspect` is
  /// width over height.
  Ray ray(float x, float y, float aspect) const {
    const Vector forward = normalize_or_up(target - position);
    const Vector right = normalize_or_up(cross(forward, Vector{0, 0, 1}));
    const Vector up = cross(right, forward);
    const float half = std::tan(degrees * std::numbers::pi_v<float> / 360);
    return {position, normalize_or_up(forward + half * aspect * (2 * x - 1) * right +
                                      half * (1 - 2 * y) * up)};
  }
};

}  // namespace vndf::render
