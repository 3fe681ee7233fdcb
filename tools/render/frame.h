// The shading frame at a point of a surface, in which BSDFs are given: z is the normal and x the
// tangent, along which alpha.x is measured.
#pragma once

#include "render/vectors.h"

namespace vndf::render {

struct Frame {
  Vector x, y, z;  ///< orthonormal and right-handed

  /// The frame with the unit vector `normal` as z and x as near to `tangent` as it can be.
  static Frame around(const Vector& normal, const Vector& tangent) {
    Vector x = tangent - dot(tangent, normal) * normal;
    if (!(dot(x, x) > 1e-12f)) {  // they are parallel: any x will do
      const Vector axis = std::abs(normal.x) < 0.5f ? Vector{1, 0, 0} : Vector{0, 1, 0};
      x = axis - dot(axis, normal) * normal;
    }
    x = normalize_or_up(x);
    return {x, cross(normal, x), normal};
  }

  Vector to_local(const Vector& w) const { return {dot(w, x), dot(w, y), dot(w, z)}; }
  Vector to_world(const Vector& w) const { return w.x * x + w.y * y + w.z * z; }
};

}  // namespace vndf::render
