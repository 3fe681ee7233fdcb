// Samples all normals of a distribution in closed form, visible or not, which is the method before
// visible normals (Heitz and d'Eon 2014, Algorithm 1).
//
// A slope of unit roughness has a uniform azimuth and a radius whose CDF has a closed inverse. We
// draw it and stretch it by alpha. The published formulas give the same map as an azimuth
// atan(alpha_y / alpha_x tan(2 pi u1)) and an elevation for the roughness along that azimuth.
#pragma once

#include "vndf/reference/smith.h"

namespace vndf {

/// Samples all normals of `Shape`, with its d(), lambda() and g1().
template <class T, class Shape>
class ShapeNdf : public SmithSurface<T, Shape> {
 public:
  using Scalar = T;
  static constexpr bool kVisible = false;

  /// Draws a normal from D(wm) wm.z whatever `wi` is, with its azimuth from u1 and its elevation
  /// from u2. A u outside [0, 1] is moved to the nearer end. Returns a unit normal with wm.z >= 0,
  /// which may face away from `wi`, and (0, 0, 1) for an input outside its range.
  Vec3<T> sample(const Vec3<T>& wi, const Alpha<T>& alpha, T u1, T u2) const noexcept {
    if (!valid(wi, alpha)) return {T(0), T(0), T(1)};
    const HomogeneousSlope<T> slope = Shape::polar_slope(probability(u2), probability(u1).u);
    // The normal leans towards the azimuth 2 pi u1, while its slope is negative along it.
    return normalize_or_up(Vec3<T>{alpha.x * slope.x, alpha.y * slope.y, slope.w});
  }

  /// Density of sample() per solid angle, D(wm) wm.z.
  T pdf(const Vec3<T>& wi, const Vec3<T>& wm, const Alpha<T>& alpha) const noexcept {
    return valid(wi, alpha) ? this->d(wm, alpha) * wm.z : T(0);
  }
};

}  // namespace vndf
