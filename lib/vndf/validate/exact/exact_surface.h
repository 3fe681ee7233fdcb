// A surface in the numbers that a user gives, with the affine map of slopes as the exact side has
// it. Slopes of unit roughness s become x = mean + M s, where
//
//   M M^T = ((ax^2, k ax ay), (k ax ay, ay^2)),   k = correlation.
//
// A sampler may take any such M: its normals have the same distribution for all of them. The
// library shears (rough_surface.h), so its M is triangular. The M here is the symmetric square
// root, so that no mistake of the shear is made twice. Nothing of the library's class is used.
//
// With w' = (M^T w_xy, w.z - w_xy . mean) a facet of the slope x is seen under w'.z - w'_xy . s, as
// one of the slope s is seen from w' on a surface of unit roughness (Dupuy et al. 2013, LEADR).
#pragma once

#include <cmath>

#include "vndf/vec.h"

namespace vndf::validate {

class ExactSurface {
 public:
  Alpha<double> alpha;      ///< roughness > 0 along x and y
  double correlation = 0;   ///< of the slopes, in (-1, 1)
  Vec2<double> mean{0, 0};  ///< the mean slope: that of the facet (-mean.x, -mean.y, 1)

  ExactSurface(const Alpha<double>& alpha_, double correlation_ = 0,
               const Vec2<double>& mean_ = {0, 0})
      : alpha(alpha_), correlation(correlation_), mean(mean_) {
    // The square root of a symmetric 2 x 2 matrix C is (C + s) / sqrt(trace + 2 s), s = sqrt(|C|).
    const double xx = alpha.x * alpha.x, yy = alpha.y * alpha.y, xy = alpha.x * alpha.y;
    determinant_ = xy * std::sqrt((1 - correlation) * (1 + correlation));
    const double scale = 1 / std::sqrt(xx + yy + 2 * determinant_);
    xx_ = (xx + determinant_) * scale;
    yy_ = (yy + determinant_) * scale;
    xy_ = correlation * xy * scale;
  }

  /// |M|.
  double determinant() const { return determinant_; }

  bool is_flat() const { return correlation == 0 && mean.x == 0 && mean.y == 0; }

  /// The area that the mean facet shows to w, per area of the surface; negative from behind it.
  double height(const Vec3<double>& w) const { return w.z - w.x * mean.x - w.y * mean.y; }

  /// w', of any length.
  Vec3<double> stretched(const Vec3<double>& w) const {
    return {xx_ * w.x + xy_ * w.y, xy_ * w.x + yy_ * w.y, height(w)};
  }
  /// |w'_xy|.
  double horizontal(const Vec3<double>& w) const {
    const Vec3<double> s = stretched(w);
    return std::hypot(s.x, s.y);
  }
  /// The angle between w' and the normal, in radians from 0 to pi.
  double stretched_angle(const Vec3<double>& w) const {
    return std::atan2(horizontal(w), height(w));
  }

  /// The numerators (s.x, s.y) of the slope of unit roughness, over wm.z, of the normal `wm`.
  Vec2<double> unit_slope(const Vec3<double>& wm) const {
    const double x = -wm.x - mean.x * wm.z, y = -wm.y - mean.y * wm.z;
    return {(yy_ * x - xy_ * y) / determinant_, (xx_ * y - xy_ * x) / determinant_};
  }
  /// The normal, of any length, whose slope of unit roughness is (s.x / w, s.y / w).
  Vec3<double> normal_of(const Vec2<double>& s, double w) const {
    return {-(xx_ * s.x + xy_ * s.y) - mean.x * w, -(xy_ * s.x + yy_ * s.y) - mean.y * w, w};
  }

  /// The unit vector of slopes s along which the slope x of the surface alone changes.
  Vec2<double> along_x() const { return {xx_ / alpha.x, xy_ / alpha.x}; }

  /// By how much a slope of unit roughness changes where the slopes of a normal are rounded by a
  /// part of 1 of each: at most this times the part, and about 1 where there is no mean slope.
  double rounding() const {
    const double along = std::sqrt((1 - correlation) * (1 + correlation));
    return (1 + std::abs(mean.x) / alpha.x + std::abs(mean.y) / alpha.y) / along;
  }

 private:
  double xx_, xy_, yy_, determinant_;
};

}  // namespace vndf::validate
