// The surface that a scene has: rough along any axes, and tilted. Slopes of unit roughness s become
// the slopes of the surface x = mean + M s, where M M^T says how they are stretched and correlated.
// Filtered normal and displacement maps (Dupuy et al. 2013, LEADR) and scratches at any angle are
// such surfaces.
//
// A facet of the slope x has the normal (-x, 1) up to its length, and we take M to be lower
// triangular, M = ((a_x, 0), (k a_x, a_y)). Then the normals of the surface are those of the flat
// surface of roughness (a_x, a_y), whose slopes have neither correlation nor mean, after a shear:
//
//   m = S m',   w.m = (S^T w).m',   S = ((1, 0, -mean_x), (k, 1, -mean_y), (0, 0, 1)),   |S| = 1.
//
// So every function of a sampler of flat surfaces serves this one, with directions S^T w and
// normals S^-1 m, whatever the sampler is. Both are any length; D has the degree -4 in m', because
// D(m) = p22(x) / m.z^4, and densities of visible normals have -3.
//
// Lambda and G1 are those relative to the mean normal, as in LEADR: G1(w) is the visible part of
// the area that the mean facet (-mean, 1) shows to w, which is (S^T w).z.
#pragma once

#include <cmath>
#include <limits>

#include "vndf/vec.h"

namespace vndf {

/// A surface. Valid where its alpha is valid and all numbers are finite.
template <class T>
class RoughSurface {
 public:
  /// Without correlation and mean.
  VNDF_DEVICE RoughSurface(const Alpha<T>& alpha) : alpha_(alpha) {}
  /// What alpha(), shear() and mean() said of a surface, which is how to store one.
  VNDF_DEVICE RoughSurface(const Alpha<T>& alpha, T shear, const Vec2<T>& mean)
      : alpha_(alpha), mean_x_(mean.x), shear_(shear), mean_y_(mean.y) {}

  /// The same surface in another precision.
  template <class U>
  VNDF_DEVICE explicit RoughSurface(const RoughSurface<U>& o)
      : RoughSurface({T(o.alpha().x), T(o.alpha().y)}, T(o.shear()),
                     {T(o.mean().x), T(o.mean().y)}) {}

  /// Slopes along x and y in units of `alpha` with this correlation in (-1, 1) about the mean slope
  /// (mean.x, mean.y): that of the facet (-mean.x, -mean.y, 1). These are the numbers that maps are
  /// reported with (distributions/slope_map.h).
  VNDF_DEVICE static RoughSurface correlated(const Alpha<T>& alpha, T correlation,
                                             const Vec2<T>& mean = {0, 0}) {
    const T along = std::sqrt((T(1) - correlation) * (T(1) + correlation));
    return {{alpha.x, alpha.y * along}, correlation * alpha.y / alpha.x, mean};
  }

  /// The slopes have the covariance ((xx, xy), (xy, yy)) in units of the square of alpha, which is
  /// twice the variance for Beckmann.
  VNDF_DEVICE static RoughSurface from_covariance(T xx, T xy, T yy, const Vec2<T>& mean = {0, 0}) {
    const T x = std::sqrt(xx), k = xy / xx;
    return {{x, std::sqrt(yy - k * xy)}, k, mean};
  }

  /// A surface of roughness `alpha` that was turned by `angle` radians about z, from x towards y.
  VNDF_DEVICE static RoughSurface turned(const Alpha<T>& alpha, T angle,
                                         const Vec2<T>& mean = {0, 0}) {
    const T c = std::cos(angle), s = std::sin(angle);
    const T a = alpha.x * alpha.x, b = alpha.y * alpha.y;
    // The determinant of the covariance does not change, and cancels less than a difference.
    const T xx = a * c * c + b * s * s, x = std::sqrt(xx);
    return {{x, alpha.x * alpha.y / x}, (a - b) * c * s / xx, mean};
  }

  /// Roughness of the flat surface.
  VNDF_DEVICE const Alpha<T>& alpha() const noexcept { return alpha_; }
  /// k of the shear.
  VNDF_DEVICE T shear() const noexcept { return shear_; }
  /// Mean slope.
  VNDF_DEVICE Vec2<T> mean() const noexcept { return {mean_x_, mean_y_}; }
  /// Whether the surface is its flat surface, so that nothing is to be done.
  VNDF_DEVICE bool is_flat() const noexcept {
    return shear_ == T(0) && mean_x_ == T(0) && mean_y_ == T(0);
  }

  /// S^T w: the direction to the flat surface, of any length.
  VNDF_DEVICE Vec3<T> flattened_direction(const Vec3<T>& w) const noexcept {
    return {w.x + shear_ * w.y, w.y, w.z - mean_x_ * w.x - mean_y_ * w.y};
  }
  /// S^-1 m: the normal of the flat surface, of any length.
  VNDF_DEVICE Vec3<T> flattened_normal(const Vec3<T>& m) const noexcept {
    const T x = m.x + mean_x_ * m.z;
    return {x, m.y + mean_y_ * m.z - shear_ * x, m.z};
  }
  /// S m: inverse of flattened_normal().
  VNDF_DEVICE Vec3<T> tilted_normal(const Vec3<T>& m) const noexcept {
    return {m.x - mean_x_ * m.z, m.y + shear_ * m.x - mean_y_ * m.z, m.z};
  }

  /// A unit normal of the flat surface that was drawn with its density, on this surface.
  VNDF_DEVICE SampledNormal<T> tilted(const SampledNormal<T>& flat) const noexcept {
    // The density 0 says that the input was outside its range, and the normal is a fallback.
    if (is_flat() || !(flat.pdf > T(0))) return flat;
    const Vec3<T> m = tilted_normal(flat.wm);
    const T length = std::sqrt(m.x * m.x + m.y * m.y + m.z * m.z), scale = T(1) / length;
    const T pdf = flat.pdf * length * length * length;
    return {{m.x * scale, m.y * scale, m.z * scale}, pdf < kLargest ? pdf : kLargest};
  }

  /// The area that the mean facet shows to w for each unit of area of the surface: w.z where the
  /// surface is flat. Negative where w is behind it.
  VNDF_DEVICE T projected_area(const Vec3<T>& w) const noexcept { return flattened_direction(w).z; }

  /// The same surface seen from below, in mirrored directions (x, y, -z).
  VNDF_DEVICE RoughSurface from_below() const noexcept {
    return {alpha_, shear_, {-mean_x_, -mean_y_}};
  }

 private:
  static constexpr T kLargest = std::numeric_limits<T>::max();

  Alpha<T> alpha_;
  // The shear is between the means, because compilers would load two neighbours at once. Where they
  // were written one by one just before, processors wait for that, twice as long as a sample takes.
  T mean_x_ = 0, shear_ = 0, mean_y_ = 0;
};

}  // namespace vndf
