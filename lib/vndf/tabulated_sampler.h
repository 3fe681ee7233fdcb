// Sampling and evaluating the distribution of visible normals from the pair of tables, at any
// roughness, anisotropy and incidence (Heitz and d'Eon 2014, Algorithm 4 and equations 1 to 3).
// This is the method as the paper has it, in single or double precision; the tables that a renderer
// bakes (kernel.h) are measured against it.
//
// Inputs of every function: directions are unit vectors; alpha > 0, tested from 1e-4 to 10 at
// ratios up to 1:1000. For an input outside its range (alpha <= 0, a component that is not a
// number) each function returns the fallback that it states; no function allocates or throws. wi may
// also be below the horizon. Slopes are fractions with a common denominator, so that none overflows,
// whatever the tail.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "vndf/select.h"
#include "vndf/slope_tables.h"
#include "vndf/stretch.h"
#include "vndf/table_coordinates.h"
#include "vndf/vec.h"
#include "vndf/visible_slope_map.h"

namespace vndf {

template <class T>
class TabulatedSampler {
 public:
  using Scalar = T;
  static constexpr bool kVisible = true;

  /// Shares `tables`, which must not be null.
  explicit TabulatedSampler(std::shared_ptr<const SlopeTables> tables)
      : mean_slope_(static_cast<T>(tables->mean_slope)),
        log_ndf_(tables->log_ndf),
        log_backfacing_(tables->log_backfacing),
        map_(std::move(tables)) {}

  const SlopeTables& tables() const { return map_.tables(); }

  /// Draws a normal visible from `wi`. slope_x increases with u1 and slope_y with u2 in
  /// the frame of the stretched incident direction. Any u is accepted; outside [0, 1] it is moved
  /// to the nearer end, where the slope is infinite and the normal horizontal. At the exact pole
  /// the azimuth is taken as 0. Returns a unit normal with wm.z >= 0 and dot(wi, wm) >=
  /// -kFacingSlack<T>; (0, 0, 1) for an input outside its range. From below the horizon it is also
  /// (0, 0, 1) where nothing is visible: where slopes are bounded, from directions that see less
  /// than 1e-13 of the surface. Straight from below infinite slopes are visible, and the normal is
  /// horizontal.
  Vec3<T> sample(const Vec3<T>& wi, const Alpha<T>& alpha, T u1, T u2) const noexcept {
    if (!valid_anywhere(wi, alpha)) return {T(0), T(0), T(1)};
    // 1. stretch
    const Stretched s = stretch(wi, alpha);
    if (!map_.sees(s.c)) return {T(0), T(0), T(1)};
    // 2. sample the slope of the stretched configuration
    const HomogeneousSlope<T> slope = map_.at(s.c, columns_of(u1, u2)).slope;
    // 3. rotate, 4. unstretch, 5. compute the normal
    return unstretched_normal(visible(slope, s), s.phi, s.alpha);
  }

  /// Density of normals D(wm) per solid angle; 0 for a horizontal or back-facing normal.
  T d(const Vec3<T>& wm, const Alpha<T>& alpha) const noexcept {
    if (!valid_anywhere(wm, alpha) || !(wm.z > T(0))) return T(0);
    const Alpha<T> a = normalized(alpha);
    const T hx = wm.x / a.x, hy = wm.y / a.y;
    const T horizontal = hx * hx + hy * hy;
    const T square = horizontal + wm.z * wm.z;
    // The slope of a nearly horizontal normal may leave the range of T; D itself does not.
    const T slope = std::min(std::sqrt(horizontal) / wm.z, std::numeric_limits<T>::max());
    return log_ndf_.at(std::asinh(slope)) / (a.x * a.y * square * square);
  }

  /// Smith's Lambda(w) of the direction or its mirror below the horizon; infinite at the
  /// horizon and next to it, where it is beyond the largest number.
  T lambda(const Vec3<T>& w, const Alpha<T>& alpha) const noexcept {
    if (!valid_anywhere(w, alpha)) return T(0);
    return backfacing_area(w, alpha) / std::abs(w.z);
  }

  /// Smith's masking G1(w) = 1 / (1 + Lambda(w)); 0 for an input outside its range.
  T g1(const Vec3<T>& w, const Alpha<T>& alpha) const noexcept {
    if (!valid_anywhere(w, alpha) || w.z == T(0)) return T(0);
    const T z = std::abs(w.z);
    return z / (z + backfacing_area(w, alpha));
  }

  /// Projected area of the facets that face `w`, per area of the surface: w.z (1 + Lambda(w)) above
  /// the horizon and |w.z| Lambda(w) below it; 0 for an input outside its range.
  T visible_area(const Vec3<T>& w, const Alpha<T>& alpha) const noexcept {
    if (!valid_anywhere(w, alpha)) return T(0);
    return std::max(w.z, T(0)) + backfacing_area(w, alpha);
  }

  /// Density of the exact distribution per solid angle, D_wi(wm) = dot(wi, wm)+ D(wm) over the
  /// visible area of wi (equation 2); 0 for an input outside its range and where nothing is
  /// visible.
  T pdf(const Vec3<T>& wi, const Vec3<T>& wm, const Alpha<T>& alpha) const noexcept {
    const T cosine = dot(wi, wm), area = visible_area(wi, alpha);
    if (!(cosine > T(0) && area > T(0))) return T(0);
    return std::min(cosine * d(wm, alpha) / area, std::numeric_limits<T>::max());
  }

  /// The normal of sample() with the density that the interpolated map has there, the reciprocal of
  /// its Jacobian. An estimate that divides by this density rather than by pdf() has no error of
  /// the tables, at any size of them whose rows increase and reach the farthest slope.
  ///
  /// The density is 0 at u1 or u2 = 0 or 1, the boundary of the normals, and for an input outside
  /// its range. Where the map is flat, so that many u give the same normal, it is the largest
  /// finite number, and those samples get negligible weight.
  SampledNormal<T> sample_with_density(const Vec3<T>& wi, const Alpha<T>& alpha, T u1,
                                       T u2) const noexcept {
    if (!valid_anywhere(wi, alpha)) return {{T(0), T(0), T(1)}, T(0)};
    const Stretched s = stretch(wi, alpha);
    if (!map_.sees(s.c)) return {{T(0), T(0), T(1)}, T(0)};
    const MappedSlope<T> mapped = map_.at(s.c, columns_of(u1, u2));
    const Vec3<T> normal = unstretched(visible(mapped.slope, s), s.phi, s.alpha);
    return {normalize_or_up(normal), density(mapped, std::sqrt(dot(normal, normal)), s.alpha)};
  }

  /// Inverse of sample(): the (u1, u2) that give `wm`, one of them where the map is flat or `wm` is
  /// horizontal. Returns nothing where there is none, to kRangeSlack<T>, or where an input is
  /// outside its range. Maximum error of invert(sample(u)): kInverseError<T>.
  std::optional<Vec2<T>> invert(const Vec3<T>& wi, const Vec3<T>& wm,
                                const Alpha<T>& alpha) const noexcept {
    if (!valid_anywhere(wi, alpha) || !valid(wm, alpha)) return {};
    const Stretched s = stretch(wi, alpha);
    if (!map_.sees(s.c)) return {};
    const auto columns = map_.inverse(s.c, stretched(wm, s.phi, s.alpha));
    if (!columns) return {};
    return random_numbers_of(*columns);
  }

  /// The map of the stretched configuration, for whoever measures it.
  const VisibleSlopeMap<T>& map() const { return map_; }

 private:
  /// The stretched configuration, roughness in units in which the mean slope is 1.
  struct Stretched {
    Alpha<T> alpha;
    Azimuth<T> phi;
    BoundedSlope<T> c;
    T cotangent;
  };

  Stretched stretch(const Vec3<T>& wi, const Alpha<T>& alpha) const {
    const Alpha<T> a = normalized(alpha);
    const T x = a.x * wi.x, y = a.y * wi.y;
    const Azimuth<T> phi = azimuth(x, y);
    // Straight from below the cotangent is infinite, and what is seen is horizontal.
    constexpr T kLeast = T(-1e18);
    return {a, phi, bounded_cotangent(wi.z, phi.length, x * x + y * y),
            std::max(wi.z / phi.length, kLeast)};
  }

  /// `slope` where it faces the direction: slope x is at most the cotangent. The map keeps to that
  /// in its bounded form, whose rounding the mean slope and roughness multiply; it reaches 4e-5 in
  /// dot(wi, wm) for heavy tails. At the pole the cotangent is infinite or not a number, and the
  /// slope stays as it is.
  static HomogeneousSlope<T> visible(const HomogeneousSlope<T>& slope, const Stretched& s) {
    return {smaller(s.cotangent * slope.w, slope.x), slope.y, slope.w};
  }

  /// Density per solid angle of a normal that had the length `l` before it was normalised. Of
  /// slopes it is du / (dx dy), and dm = wm.z^3 alpha_x alpha_y dx dy with wm.z = d e / l, so that
  ///
  ///   pdf = du l^3 / (2 alpha_x alpha_y h S e (1 + v^2) dsigma dv)   (visible_slope_map.h).
  static T density(const MappedSlope<T>& mapped, T l, const Alpha<T>& alpha) {
    constexpr T kLargest = std::numeric_limits<T>::max();
    if (!(mapped.du > T(0))) return T(0);
    const T jacobian = T(2) * (alpha.x * alpha.y) * mapped.jacobian;
    return jacobian > T(0) ? std::min(mapped.du * l * l * l / jacobian, kLargest) : kLargest;
  }

  /// Roughness in units in which the mean slope is 1.
  Alpha<T> normalized(const Alpha<T>& alpha) const {
    return {alpha.x * mean_slope_, alpha.y * mean_slope_};
  }

  /// |w.z| Lambda(w): the projected area of the facets that face away from w or, below the horizon,
  /// of those that face it.
  T backfacing_area(const Vec3<T>& w, const Alpha<T>& alpha) const {
    const Alpha<T> a = normalized(alpha);
    const T horizontal = azimuth(a.x * w.x, a.y * w.y).length;
    if (horizontal == T(0)) return T(0);
    return horizontal * log_backfacing_.at(std::asinh(std::abs(w.z) / horizontal));
  }

  T mean_slope_;
  LogCurve<T> log_ndf_, log_backfacing_;
  VisibleSlopeMap<T> map_;
};

}  // namespace vndf
