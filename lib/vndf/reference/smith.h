// Evaluates D, Lambda and G1 of a distribution in closed form at any roughness, and samples its
// visible normals by any method (Heitz and d'Eon 2014, Algorithm 4 and equations 1 to 3).
// Shape-invariance lets a distribution be given at unit roughness only, as a Shape:
//
//   Shape::density(h2, z)            p22(sqrt(h2) / z) / z^4, which is D of the vector with the
//                                    horizontal part sqrt(h2) and the vertical part z; its length
//                                    cancels
//   Shape::backfacing_area(z, s)     z Lambda for the direction (s, 0, z), which need not be a unit
//                                    vector: the result is proportional to its length
//
// Inputs outside their range give the results that TabulatedSampler gives. No function allocates or
// throws.
#pragma once

#include <cmath>

#include "vndf/stretch.h"
#include "vndf/table_coordinates.h"
#include "vndf/vec.h"

namespace vndf {

/// D, Lambda and G1 of `Shape`, which states their errors.
template <class T, class Shape>
class SmithSurface {
 public:
  /// Density of normals D(wm) per solid angle; 0 for a horizontal or back-facing normal.
  T d(const Vec3<T>& wm, const Alpha<T>& alpha) const noexcept {
    if (!valid(wm, alpha) || !(wm.z > T(0))) return T(0);
    const T x = wm.x / alpha.x, y = wm.y / alpha.y;
    return Shape::density(x * x + y * y, wm.z) / (alpha.x * alpha.y);
  }

  /// Smith's Lambda(w) of the direction or its mirror below the horizon; infinite at the horizon.
  T lambda(const Vec3<T>& w, const Alpha<T>& alpha) const noexcept {
    const Vec3<T> above{w.x, w.y, std::abs(w.z)};
    return valid(above, alpha) ? backfacing_area(above, alpha) / above.z : T(0);
  }

  /// Smith's masking G1(w) = 1 / (1 + Lambda(w)); 0 for an input outside its range.
  T g1(const Vec3<T>& w, const Alpha<T>& alpha) const noexcept {
    const Vec3<T> above{w.x, w.y, std::abs(w.z)};
    if (!valid(above, alpha) || above.z == T(0)) return T(0);
    return above.z / (above.z + backfacing_area(above, alpha));
  }

 protected:
  /// w.z Lambda(w): the projected area of the facets that face away from w.
  static T backfacing_area(const Vec3<T>& w, const Alpha<T>& alpha) {
    const T s = azimuth(alpha.x * w.x, alpha.y * w.y).length;
    return s == T(0) ? T(0) : Shape::backfacing_area(w.z, s);
  }
};

/// The incident direction (sin, 0, cos), stretched to unit roughness.
template <class T>
struct Incidence {
  T cos, sin;
};

/// The same direction, of unit length to the rounding of double.
template <class T>
Incidence<double> in_double(const Incidence<T>& wi) {
  const double cos = wi.cos, sin = wi.sin, length = std::hypot(cos, sin);
  return {cos / length, sin / length};
}

/// The same probability with an exact complement.
template <class T>
Probability<double> in_double(const Probability<T>& p) {
  return {double{p.u}, 1 - double{p.u}};
}

/// Samples the visible normals of `Shape`. A Method differs from others only in step 2 of Algorithm
/// 4, `Method::sample_slope(Incidence<T>, Probability<T> u1, Probability<T> u2)`, which draws the
/// slope of the stretched configuration.
template <class T, class Shape, class Method>
class VisibleSampler : public SmithSurface<T, Shape> {
 public:
  using Scalar = T;
  static constexpr bool kVisible = true;

  /// Draws a normal visible from `wi` (wi.z >= 0). A u outside [0, 1] is moved to the nearer end.
  /// At the exact pole the azimuth of wi counts as 0. Returns a unit normal with wm.z >= 0 and
  /// dot(wi, wm) >= -kFacingSlack<T>, except for methods that treat a cone as normal incidence and
  /// say so. Returns (0, 0, 1) for an input outside its range.
  Vec3<T> sample(const Vec3<T>& wi, const Alpha<T>& alpha, T u1, T u2) const noexcept {
    if (!valid(wi, alpha)) return {T(0), T(0), T(1)};
    // 1. stretch
    const Azimuth<T> phi = azimuth(alpha.x * wi.x, alpha.y * wi.y);
    const T length = std::hypot(phi.length, wi.z);
    // 2. sample the slope of the stretched configuration
    const HomogeneousSlope<T> slope = Method::sample_slope(
        Incidence<T>{wi.z / length, phi.length / length}, probability(u1), probability(u2));
    // 3. rotate, 4. unstretch, 5. compute the normal
    return unstretched_normal(slope, phi, alpha);
  }

  /// Density of visible normals per solid angle, D_wi(wm) = dot(wi, wm)+ D(wm) / (wi.z (1 +
  /// Lambda(wi))) (equation 2), finite up to the horizon; 0 for an input outside its range. It is
  /// the density of sample() up to the error of the method.
  T pdf(const Vec3<T>& wi, const Vec3<T>& wm, const Alpha<T>& alpha) const noexcept {
    const T cosine = dot(wi, wm);
    if (!valid(wi, alpha) || !(cosine > T(0))) return T(0);
    return cosine * this->d(wm, alpha) / (wi.z + this->backfacing_area(wi, alpha));
  }
};

}  // namespace vndf
