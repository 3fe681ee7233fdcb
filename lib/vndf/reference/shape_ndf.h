// Sampling all normals of a distribution known in closed form, visible or not: the method before
// visible normals (Heitz and d'Eon 2014, Algorithm 1).
//
// A slope of unit roughness has a uniform azimuth and a radius of closed inverse; alpha stretches
// it. This is the same map as an azimuth atan(alpha_y / alpha_x tan(2 pi u1)) and an elevation of
// the roughness along it, 1 / alpha^2 = cos^2(phi) / alpha_x^2 + sin^2(phi) / alpha_y^2.
#pragma once

#include "vndf/reference/smith.h"

namespace vndf {

template <class T, class Shape>
class ShapeNdf : public SmithSurface<T, Shape> {
 public:
  using Scalar = T;
  static constexpr bool kVisible = false;

  /// Draws a normal from D(wm) wm.z, whatever `wi` is: its azimuth from u1, its elevation from u2.
  /// Any u is accepted; outside [0, 1] it is moved to the nearer end. Returns a unit normal with
  /// wm.z >= 0, which may face away from `wi`; (0, 0, 1) for an input outside its range.
  Vec3<T> sample(const Vec3<T>& wi, const Alpha<T>& alpha, T u1, T u2) const noexcept {
    if (!valid(wi, alpha)) return {T(0), T(0), T(1)};
    const HomogeneousSlope<T> slope = Shape::polar_slope(probability(u2), probability(u1).u);
    // The normal leans along the azimuth 2 pi u1, its slope falls along it.
    return normalize_or_up(Vec3<T>{alpha.x * slope.x, alpha.y * slope.y, slope.w});
  }

  /// Density of sample() per solid angle, D(wm) wm.z.
  T pdf(const Vec3<T>& wi, const Vec3<T>& wm, const Alpha<T>& alpha) const noexcept {
    return valid(wi, alpha) ? this->d(wm, alpha) * wm.z : T(0);
  }
};

}  // namespace vndf
