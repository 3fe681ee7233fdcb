// The map of TabulatedSampler as a change of variables: its density, the reciprocal of the
// Jacobian, and its inverse. slope_x depends on u1 alone (equation 10 of Heitz and d'Eon 2014,
// inverted) and slope_y on both, so the Jacobian is triangular and the density of slopes is
//
//   1 / (dx/du1 dy/du2),  dy/du2 at fixed x.
//
// Along the columns t1 and t2 the tables are cubics, and with x = n / d, y = S 2 v / (d e),
// e = 1 - v^2, S / d the scale of the conditional and h / d = sqrt(1 + x^2)
// (table_coordinates.h),
//
//   dx/dt1 = (h / d^2) dsigma/dt1,   dy/dt2 = (S / d) (2 (1 + v^2) / e^2) dv/dt2.
//
// Per solid angle, dm = wm.z^3 alpha_x alpha_y dx dy. The normal is a vector of length l with
// vertical part d e, wm.z = d e / l, so that all powers of d, which vanish at infinite slopes,
// cancel:
//
//   pdf = (du1/dt1 du2/dt2) l^3 / (2 alpha_x alpha_y h S e (1 + v^2) dsigma/dt1 dv/dt2).
//
// Included by tabulated_sampler.h, which declares what is defined here.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "vndf/tabulated_sampler.h"

namespace vndf {

/// Largest |invert(sample(u)) - u| for u1 and u2 in [kInverseMargin, 1 - kInverseMargin], at any
/// incidence and roughness, where the map increases. It does not where a table holds equal values
/// next to each other, as one in single precision does where the density is infinite (Pearson II of
/// m < 0, at its rim), nor where cubics are laid across rows that are not smooth, which the
/// certificate shows.
///
/// Measured over the named families: 1e-13 in double. In float 1e-6 for most, 1e-5 for sharp edges
/// and scales of 1:100 in tables of 1024 x 1024, 4e-5 in tables of 16 x 16: the normal is rounded.
/// Nearer the ends of u double keeps 1e-12; float errs by 1.4e-4 at the rim of a disk, where the
/// scale of slope_y goes to 0, and by 2.4e-5 where slopes come near the largest float (Student-T of
/// gamma = 1.55, u1 < 1e-4), beyond which normals are horizontal and u1 is lost.
template <class T>
inline constexpr T kInverseError = T(1e-12);
template <>
inline constexpr float kInverseError<float> = 5e-5f;
inline constexpr double kInverseMargin = 1e-3;

/// Largest distance, on the sphere of stretched normals, of a normal from the range of the map that
/// invert() takes for rounding.
template <class T>
inline constexpr T kRangeSlack = T(64) * std::numeric_limits<T>::epsilon();

template <class T>
SampledNormal<T> TabulatedSampler<T>::sample_with_density(const Vec3<T>& wi, const Alpha<T>& alpha,
                                                          T u1, T u2) const noexcept {
  if (!valid(wi, alpha)) return {{T(0), T(0), T(1)}, T(0)};
  const FoldedProbability<T> folded = fold(probability(u2));
  return sample_at(stretch(wi, alpha), {marginal_column(widened(probability(u1))),
                                        conditional_column(widened(folded.p)), folded.sign});
}

template <class T>
T TabulatedSampler<T>::map_density(const Vec3<T>& wi, const Vec3<T>& wm,
                                   const Alpha<T>& alpha) const noexcept {
  if (!valid(wi, alpha) || !valid(wm, alpha)) return T(0);
  const Stretched s = stretch(wi, alpha);
  const auto columns = columns_of(s, wm);
  return columns ? sample_at(s, *columns).pdf : T(0);
}

template <class T>
std::optional<Vec2<T>> TabulatedSampler<T>::invert(const Vec3<T>& wi, const Vec3<T>& wm,
                                                   const Alpha<T>& alpha) const noexcept {
  if (!valid(wi, alpha) || !valid(wm, alpha)) return {};
  const auto columns = columns_of(stretch(wi, alpha), wm);
  if (!columns) return {};
  const FoldedProbability<double> folded{conditional_column_inverse(columns->conditional),
                                         double{columns->sign}};
  return Vec2<T>{static_cast<T>(marginal_column_inverse(columns->marginal).u),
                 static_cast<T>(unfold(folded))};
}

/// sample_marginal() with its differentials; that of sigma is 0 where it is held at the farthest.
template <class T>
auto TabulatedSampler<T>::marginal_step(const BoundedSlope<T>& c, double column) const
    -> MarginalStep {
  const BoundedSlope<T> edge = farthest(c);
  const auto s = tables_->marginal.lookup_with_derivative(marginal_row(c), column);
  const auto sigma = marginal_map_.at_with_derivative(s.value);
  const BoundedSlope<T> x = bounded_from_sigma(static_cast<T>(sigma.value));
  const bool held = !(x.sigma < edge.sigma && x.complement > edge.complement);
  return {held_below(edge, x), static_cast<T>(marginal_column_rate(column)),
          held ? T(0) : static_cast<T>(s.derivative * sigma.derivative)};
}

/// sample_conditional() with its differentials. At u2 = 1/2 both may vanish, as t; there they are
/// those of the next number.
template <class T>
auto TabulatedSampler<T>::conditional_step(double row, double column) const -> ConditionalStep {
  constexpr double kBeside = 0x1p-26;  // p = 2 kBeside^2, a rounding of 1
  const double place = std::max(column, kBeside);
  return {static_cast<T>(tables_->conditional.lookup(row, column)),
          static_cast<T>(conditional_column_rate(place) / 2),
          static_cast<T>(tables_->conditional.lookup_with_derivative(row, place).derivative)};
}

template <class T>
SampledNormal<T> TabulatedSampler<T>::sample_at(const Stretched& s, const Columns& columns) const {
  // 2.a marginal, 2.b conditional, as in sample_slope()
  const MarginalStep m = marginal_step(s.c, columns.marginal);
  const ConditionalStep k = conditional_step(conditional_row(m.x), columns.conditional);
  const SlopeFraction<T> x{m.x.numerator(), m.x.denominator()}, y = conditional_value_inverse(k.v);
  const T scale = conditional_scale_.at(x);
  const HomogeneousSlope<T> slope = joined_slope(x, columns.sign * scale, y);
  // 3. rotate, 4. unstretch, 5. compute the normal, and the density
  const Vec3<T> normal = unstretched(slope, s.phi, s.alpha);
  const T length = std::sqrt(dot(normal, normal));
  const T volume = m.du1 * k.du2 * length * length * length;
  const T jacobian = T(2) * (s.alpha.x * s.alpha.y) * (m.x.hypotenuse() * scale) *
                     (y.denominator * (T(1) + k.v * k.v)) * (m.dsigma * k.dv);
  constexpr T kLargest = std::numeric_limits<T>::max();
  const T pdf = jacobian > T(0) ? std::min(volume / jacobian, kLargest) : kLargest;
  return {normalize_or_up(normal), m.du1 * k.du2 > T(0) ? pdf : T(0)};
}

template <class T>
auto TabulatedSampler<T>::columns_of(const Stretched& s, const Vec3<T>& wm) const
    -> std::optional<Columns> {
  // Steps 4 and 3 backwards
  const HomogeneousSlope<T> slope = stretched(wm, s.phi, s.alpha);
  if (slope.x == T(0) && slope.w == T(0)) return {};  // horizontal, and no slope_x
  // Steps 2.b and 2.a backwards: the scale at x / w, times w, is that of y
  const BoundedSlope<T> x = bounded_from_fraction(slope.x, slope.w);
  const T scale = conditional_scale_.at({slope.x, slope.w});
  const T v = slope.y == T(0) ? T(0)  // at the rim of a bounded support the scale is 0 too
                              : conditional_value(bounded_from_fraction(std::abs(slope.y), scale));
  const Columns columns{
      tables_->marginal.inverse(marginal_row(s.c), marginal_map_.inverse(x.sigma)),
      tables_->conditional.inverse(conditional_row(x), v), slope.y < T(0) ? T(-1) : T(1)};
  if (!in_range(s, columns, x, v)) return {};
  return columns;
}

/// Whether the map reaches the slope x and the value v: values beyond a row have its end as their
/// column, and what the row has there is then another normal.
template <class T>
bool TabulatedSampler<T>::in_range(const Stretched& s, const Columns& columns,
                                   const BoundedSlope<T>& x, T v) const {
  const BoundedSlope<T> near_x = columns.marginal < T(1) ? x : marginal_step(s.c, 1).x;
  const T end = static_cast<T>(tables_->conditional.lookup(conditional_row(x), 1));
  const auto unit = [&](const BoundedSlope<T>& at, T value) {
    const SlopeFraction<T> fx{at.numerator(), at.denominator()};
    const auto slope =
        joined_slope(fx, conditional_scale_.at(fx), conditional_value_inverse(value));
    return normalize_or_up(Vec3<T>{slope.x, slope.y, slope.w});
  };
  const Vec3<T> m = unit(x, v), n = unit(near_x, std::min(v, end));
  return std::abs(m.x - n.x) + std::abs(m.y - n.y) + std::abs(m.z - n.z) <= kRangeSlack<T>;
}

}  // namespace vndf
