// Sampling and evaluating the distribution of visible normals from tables, at any roughness,
// anisotropy and incidence (Heitz and d'Eon 2014, Algorithm 4 and equations 1 to 3).
//
// Inputs of every function: directions are unit vectors; alpha > 0, tested from 1e-4 to 10 at
// ratios up to 1:1000. An input outside its range (alpha <= 0, a component that is not a number, wi
// below the horizon) gives the stated fallback and nothing else happens: no function allocates or
// throws. Slopes are handled as fractions with a common denominator, so none overflows, whatever
// the tail.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "vndf/slope_tables.h"
#include "vndf/stretch.h"
#include "vndf/table_coordinates.h"
#include "vndf/vec.h"

namespace vndf {

/// A normal with the density per solid angle that it was drawn with.
template <class T>
struct SampledNormal {
  Vec3<T> wm;
  T pdf;
};

/// The slope (x, scale y), with `scale` times the denominator of x as ConditionalScale gives it.
template <class T>
HomogeneousSlope<T> joined_slope(const SlopeFraction<T>& x, T scale, const SlopeFraction<T>& y) {
  return {x.numerator * y.denominator, scale * y.numerator, x.denominator * y.denominator};
}

template <class T>
class TabulatedSampler {
 public:
  using Scalar = T;
  static constexpr bool kVisible = true;

  /// Shares `tables`, which must not be null.
  explicit TabulatedSampler(std::shared_ptr<const SlopeTables> tables)
      : tables_(std::move(tables)),
        mean_slope_(static_cast<T>(tables_->mean_slope)),
        bounded_support_(bounded_from_slope(static_cast<T>(tables_->support))),
        marginal_rows_(tables_->marginal_rows),
        conditional_rows_(tables_->conditional_rows),
        conditional_scale_{static_cast<T>(tables_->conditional_constant),
                           static_cast<T>(tables_->conditional_quadratic)},
        marginal_map_(tables_->marginal_map),
        log_ndf_(tables_->log_ndf),
        log_backfacing_(tables_->log_backfacing) {}

  const SlopeTables& tables() const { return *tables_; }

  /// Draws a normal visible from `wi` (wi.z >= 0). slope_x increases with u1 and slope_y with u2 in
  /// the frame of the stretched incident direction. Any u is accepted; outside [0, 1] it is moved
  /// to the nearer end, where the slope is infinite and the normal horizontal. At the exact pole
  /// the azimuth is taken as 0. Returns a unit normal with wm.z >= 0 and dot(wi, wm) >=
  /// -kFacingSlack<T>; (0, 0, 1) for an input outside its range.
  Vec3<T> sample(const Vec3<T>& wi, const Alpha<T>& alpha, T u1, T u2) const noexcept {
    if (!valid(wi, alpha)) return {T(0), T(0), T(1)};
    // 1. stretch
    const Stretched s = stretch(wi, alpha);
    // 2. sample the slope of the stretched configuration
    const HomogeneousSlope<T> slope = sample_slope(s.c, u1, u2);
    // 3. rotate, 4. unstretch, 5. compute the normal
    return unstretched_normal(slope, s.phi, s.alpha);
  }

  /// Steps 2.a and 2.b of Algorithm 4: the slope seen from cotangent `c`, both at unit mean slope.
  HomogeneousSlope<T> sample_slope(const BoundedSlope<T>& c, T u1, T u2) const noexcept {
    // 2.a marginal
    const BoundedSlope<T> x = sample_marginal(c, probability(u1));
    // 2.b conditional: y, the slope in the table times a scale that depends on x
    const FoldedProbability<T> folded = fold(probability(u2));
    const T v = sample_conditional(x, folded.p);
    const SlopeFraction<T> fx{x.numerator(), x.denominator()};
    return joined_slope(fx, folded.sign * conditional_scale_.at(fx), conditional_value_inverse(v));
  }

  /// The marginal quantile at u1, in units of the mean slope; at most the slope `c`.
  BoundedSlope<T> sample_marginal(const BoundedSlope<T>& c,
                                  const Probability<T>& u1) const noexcept {
    const double s = tables_->marginal.lookup(marginal_row(c), marginal_column(widened(u1)));
    return held_below(farthest(c), bounded_from_sigma(static_cast<T>(marginal_map_.at(s))));
  }

  /// The value v = 2 sigma - 1 of |y| / scale that a sampled |y| stays below with probability p:
  /// |y| = scale(x) conditional_value_inverse(v).
  T sample_conditional(const BoundedSlope<T>& x, const Probability<T>& p) const noexcept {
    return static_cast<T>(
        tables_->conditional.lookup(conditional_row(x), conditional_column(widened(p))));
  }

  /// Density of normals D(wm) per solid angle; 0 for a horizontal or back-facing normal.
  T d(const Vec3<T>& wm, const Alpha<T>& alpha) const noexcept {
    if (!valid(wm, alpha) || !(wm.z > T(0))) return T(0);
    const Alpha<T> a = normalized(alpha);
    const T hx = wm.x / a.x, hy = wm.y / a.y;
    const T horizontal = hx * hx + hy * hy;
    const T square = horizontal + wm.z * wm.z;
    // The slope of a nearly horizontal normal may leave the range of T; D itself does not.
    const T slope = std::min(std::sqrt(horizontal) / wm.z, std::numeric_limits<T>::max());
    return log_ndf_.at(std::asinh(slope)) / (a.x * a.y * square * square);
  }

  /// Smith's Lambda(w) of the direction or its mirror below the horizon; infinite at the horizon.
  T lambda(const Vec3<T>& w, const Alpha<T>& alpha) const noexcept {
    const Vec3<T> above{w.x, w.y, std::abs(w.z)};
    if (!valid(above, alpha)) return T(0);
    return backfacing_area(above, alpha) / above.z;
  }

  /// Smith's masking G1(w) = 1 / (1 + Lambda(w)); 0 for an input outside its range.
  T g1(const Vec3<T>& w, const Alpha<T>& alpha) const noexcept {
    const Vec3<T> above{w.x, w.y, std::abs(w.z)};
    if (!valid(above, alpha)) return T(0);
    return above.z == T(0) ? T(0) : above.z / (above.z + backfacing_area(above, alpha));
  }

  /// Density of sample() per solid angle, D_wi(wm) = dot(wi, wm)+ D(wm) / (wi.z (1 + Lambda(wi)))
  /// (equation 2), finite up to the horizon; 0 for an input outside its range.
  T pdf(const Vec3<T>& wi, const Vec3<T>& wm, const Alpha<T>& alpha) const noexcept {
    const T cosine = dot(wi, wm);
    if (!valid(wi, alpha) || !(cosine > T(0))) return T(0);
    return cosine * d(wm, alpha) / (wi.z + backfacing_area(wi, alpha));
  }

  // The map itself: its density and its inverse (map_density.h).

  /// The normal of sample(), with the density of the interpolated map there: the reciprocal of its
  /// Jacobian. An integral of f estimated by the mean of f(wm) / pdf has no error of the tables, at
  /// any size of them whose rows increase and reach the farthest slope. pdf is >= 0 and finite. It
  /// is 0 at u1 or u2 = 0 or 1, the boundary of the normals, and for an input outside its range;
  /// the largest number where the map is flat, that is where many u give one normal, so that such u
  /// weigh nothing.
  SampledNormal<T> sample_with_density(const Vec3<T>& wi, const Alpha<T>& alpha, T u1,
                                       T u2) const noexcept;

  /// The same density at any normal `wm`; 0 for one that sample() does not give.
  T map_density(const Vec3<T>& wi, const Vec3<T>& wm, const Alpha<T>& alpha) const noexcept;

  /// The (u1, u2) for which sample() gives `wm`; one of them where the map is flat or `wm`
  /// horizontal; nothing where there is none, to kRangeSlack<T>, or an input is outside its range.
  /// Maximum error of invert(sample(u)): kInverseError<T> (map_density.h).
  std::optional<Vec2<T>> invert(const Vec3<T>& wi, const Vec3<T>& wm,
                                const Alpha<T>& alpha) const noexcept;

 private:
  /// The stretched configuration, roughness in units in which the mean slope is 1.
  struct Stretched {
    Alpha<T> alpha;
    Azimuth<T> phi;
    BoundedSlope<T> c;
  };
  /// Columns of the two tables, and the sign of slope_y: what u1 and u2 stand for.
  struct Columns {
    double marginal, conditional;
    T sign;
  };
  /// The two steps of the map with their differentials along the column.
  struct MarginalStep {
    BoundedSlope<T> x;
    T du1, dsigma;
  };
  struct ConditionalStep {
    T v, du2, dv;
  };

  Stretched stretch(const Vec3<T>& wi, const Alpha<T>& alpha) const {
    const Alpha<T> a = normalized(alpha);
    const T x = a.x * wi.x, y = a.y * wi.y;
    const Azimuth<T> phi = azimuth(x, y);
    return {a, phi, bounded_cotangent(wi.z, phi.length, x * x + y * y)};
  }

  /// The largest slope seen from cotangent `c`.
  BoundedSlope<T> farthest(const BoundedSlope<T>& c) const {
    return held_below(bounded_support_, c);
  }

  /// Row coordinates of the tables.
  double marginal_row(const BoundedSlope<T>& c) const {
    return marginal_rows_.row(marginal_base(widened(c)));
  }
  double conditional_row(const BoundedSlope<T>& x) const {
    return conditional_rows_.row(conditional_base(widened(x)));
  }

  MarginalStep marginal_step(const BoundedSlope<T>& c, double column) const;
  ConditionalStep conditional_step(double row, double column) const;
  SampledNormal<T> sample_at(const Stretched& s, const Columns& columns) const;
  std::optional<Columns> columns_of(const Stretched& s, const Vec3<T>& wm) const;
  bool in_range(const Stretched& s, const Columns& columns, const BoundedSlope<T>& x, T v) const;

  /// Roughness in units in which the mean slope is 1.
  Alpha<T> normalized(const Alpha<T>& alpha) const {
    return {alpha.x * mean_slope_, alpha.y * mean_slope_};
  }

  /// wi.z Lambda(wi): the projected area of the facets that face away from wi.
  T backfacing_area(const Vec3<T>& w, const Alpha<T>& alpha) const {
    const Alpha<T> a = normalized(alpha);
    const T horizontal = azimuth(a.x * w.x, a.y * w.y).length;
    if (horizontal == T(0)) return T(0);
    return horizontal * log_backfacing_.at(std::asinh(w.z / horizontal));
  }

  std::shared_ptr<const SlopeTables> tables_;
  T mean_slope_;
  BoundedSlope<T> bounded_support_;
  RowAxis marginal_rows_, conditional_rows_;
  ConditionalScale<T> conditional_scale_;
  MonotoneMap marginal_map_;
  LogCurve<T> log_ndf_, log_backfacing_;
};

}  // namespace vndf

#include "vndf/map_density.h"
