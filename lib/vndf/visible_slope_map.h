// Step 2 of Algorithm 4 (Heitz and d'Eon 2014): the map from two random numbers to a slope that is
// visible in the stretched configuration, with its differential and its inverse. The sampler and
// the certificate both need it, and only here the tables are looked up.
//
// slope_x depends on u1 alone (2.a, equation 10 inverted) and slope_y on both (2.b, equation 13
// inverted), so the Jacobian is triangular and the density of slopes is
//
//   1 / (dx/du1 dy/du2),  dy/du2 at fixed x.
//
// Along the columns t1 and t2 the tables are cubics. With x = n / d and y = S 2 v / (d e),
// e = 1 - v^2, where S / d is the scale of the conditional and h / d = sqrt(1 + x^2)
// (table_coordinates.h),
//
//   dx/dt1 = (h / d^2) dsigma/dt1,   dy/dt2 = (S / d) (2 (1 + v^2) / e^2) dv/dt2.
//
// The slope is returned as the vector (n e, S 2 v, d e), so that all powers of d and e, which
// vanish at infinite slopes, cancel once the slope becomes a normal: see TabulatedSampler.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "vndf/pair_coordinates.h"
#include "vndf/slope_tables.h"
#include "vndf/stretch.h"
#include "vndf/table_coordinates.h"
#include "vndf/vec.h"

namespace vndf {

/// Largest |invert(sample(u)) - u| for u1 and u2 in [kInverseMargin, 1 - kInverseMargin], at any
/// incidence and roughness, where the map increases. The map does not increase where a table holds
/// equal values next to each other, as one in single precision does where the density is infinite
/// (Pearson II of m < 0, at its rim), nor where cubics are laid across rows that are not smooth,
/// which the certificate shows.
///
/// Measured over the named families: 1e-13 in double. In float the normal is rounded, which costs
/// 1e-6 for most, 1e-5 for sharp edges and scales of 1:100 in tables of 1024 x 1024, and 4e-5 in
/// tables of 16 x 16. Nearer the ends of u double keeps 1e-12; float errs by 1.4e-4 at the rim of a
/// disk, where the scale of slope_y goes to 0, and by 2.4e-5 where slopes come near the largest
/// float (Student-T of gamma = 1.55, u1 < 1e-4), beyond which normals are horizontal and u1 is
/// lost.
template <class T>
inline constexpr T kInverseError = T(1e-12);
template <>
inline constexpr float kInverseError<float> = 5e-5f;
inline constexpr double kInverseMargin = 1e-3;

/// Largest distance, on the sphere of stretched normals, between a normal and the range of the map
/// that inversion takes for rounding.
template <class T>
inline constexpr T kRangeSlack = T(64) * std::numeric_limits<T>::epsilon();

/// What u1 and u2 stand for: the columns of the two tables, and the sign of slope_y.
template <class T>
struct TableColumns {
  double marginal, conditional;
  T sign;
};

/// The columns of two random numbers. A number outside [0, 1] is moved to the nearer end.
template <class T>
[[gnu::always_inline]] inline TableColumns<T> columns_of(T u1, T u2) {
  const FoldedProbability<T> folded = fold(probability(u2));
  return {marginal_column(widened(probability(u1))), conditional_column(widened(folded.p)),
          folded.sign};
}

/// Inverse of columns_of().
template <class T>
Vec2<T> random_numbers_of(const TableColumns<T>& columns) {
  const FoldedProbability<double> folded{conditional_column_inverse(columns.conditional),
                                         double{columns.sign}};
  return {static_cast<T>(marginal_column_inverse(columns.marginal).u),
          static_cast<T>(unfold(folded))};
}

/// A slope of the map, with what the change of variables needs: the area du1 du2 of random numbers,
/// and h S e (1 + v^2) dsigma dv, both per unit of the columns.
template <class T>
struct MappedSlope {
  HomogeneousSlope<T> slope;
  T du, jacobian;
};

template <class T>
class VisibleSlopeMap {
 public:
  /// Shares `tables`, which must not be null.
  explicit VisibleSlopeMap(std::shared_ptr<const SlopeTables> tables)
      : tables_(std::move(tables)),
        support_(bounded_from_slope(static_cast<T>(tables_->support))),
        coordinates_(*tables_),
        scale_{static_cast<T>(coordinates_.scale.constant),
               static_cast<T>(coordinates_.scale.quadratic)},
        lowest_(std::isinf(tables_->support) && coordinates_.reaches_below()
                    ? T(0)
                    : static_cast<T>(coordinates_.marginal_row_inverse(1).sigma)) {}

  const SlopeTables& tables() const { return *tables_; }
  const PairCoordinates& coordinates() const { return coordinates_; }

  /// Whether slopes are visible from cotangent `c`. Of a bounded distribution none are from below
  /// the last row, nor of any where no row is below the horizon.
  bool sees(const BoundedSlope<T>& c) const noexcept {
    return c.sigma >= c.complement || c.sigma >= lowest_;
  }

  /// 2.a: the quantile of slope_x at u1, seen from cotangent `c`; it is at most `c`.
  BoundedSlope<T> marginal(const BoundedSlope<T>& c, const Probability<T>& u1) const noexcept {
    return marginal_at(c, marginal_column(widened(u1))).x;
  }

  /// 2.b: the value v = 2 sigma - 1 of |y| / scale that a sampled |y| stays below with probability
  /// `p`, given slope `x`: |y| = scale(x) conditional_value_inverse(v).
  T conditional(const BoundedSlope<T>& x, const Probability<T>& p) const noexcept {
    return conditional_at(x, conditional_column(widened(p))).v;
  }

  /// Steps 2.a and 2.b: the slope at `columns`, seen from cotangent `c`. It is put in place, so
  /// that a caller who needs the slope alone does not wait for the differentials.
  [[gnu::always_inline]] MappedSlope<T> at(const BoundedSlope<T>& c,
                                           const TableColumns<T>& columns) const noexcept {
    const MarginalStep m = marginal_at(c, columns.marginal);
    const ConditionalStep k = conditional_at(m.x, columns.conditional);
    const SlopeFraction<T> x{m.x.numerator(), m.x.denominator()};
    const SlopeFraction<T> y = conditional_value_inverse(k.v);
    const T scale = scale_.at(x);
    return {joined(x, columns.sign * scale, y), m.du1 * k.du2,
            (m.x.hypotenuse() * scale) * (y.denominator * (T(1) + k.v * k.v)) * (m.dsigma * k.dv)};
  }

  /// Inverse of at(): the columns whose slope is `slope`, any of them where the map is flat;
  /// nothing where the map does not reach it, to kRangeSlack<T>, or where it has no slope_x.
  std::optional<TableColumns<T>> inverse(const BoundedSlope<T>& c,
                                         const HomogeneousSlope<T>& slope) const noexcept {
    if (slope.x == T(0) && slope.w == T(0)) return {};
    const BoundedSlope<T> x = bounded_from_fraction(slope.x, slope.w);
    // The scale at x / w comes out times w, as slope.y is. It is 0 at the rim of a bounded support,
    // where slope.y is 0 too and their quotient would be no number.
    const T scale = scale_.at({slope.x, slope.w});
    const T v =
        slope.y == T(0) ? T(0) : conditional_value(bounded_from_fraction(std::abs(slope.y), scale));
    const TableColumns<T> columns{
        tables_->marginal.inverse(marginal_row(c),
                                  coordinates_.marginal_map.inverse(x.sigma / widened_scale(c))),
        tables_->conditional.inverse(conditional_row(x), v), slope.y < T(0) ? T(-1) : T(1)};
    if (!reaches(c, columns, x, v)) return {};
    return columns;
  }

 private:
  /// Each step with its differentials along the column.
  struct MarginalStep {
    BoundedSlope<T> x;
    T du1, dsigma;
  };
  struct ConditionalStep {
    T v, du2, dv;
  };

  static double widened_scale(const BoundedSlope<T>& c) { return marginal_scale(widened(c)); }
  double marginal_row(const BoundedSlope<T>& c) const {
    return coordinates_.marginal_row(widened(c));
  }
  double conditional_row(const BoundedSlope<T>& x) const {
    return coordinates_.conditional_row(widened(x));
  }

  /// The slope is clamped to the farthest one that is seen, for rounding may carry it beyond; there
  /// dsigma is 0.
  [[gnu::always_inline]] MarginalStep marginal_at(const BoundedSlope<T>& c, double column) const {
    const BoundedSlope<T> edge = clamp_below(support_, c);
    const auto s = tables_->marginal.lookup_with_derivative(marginal_row(c), column);
    const auto sigma = coordinates_.marginal_map.at_with_derivative(s.value);
    const double scale = widened_scale(c);
    const BoundedSlope<T> x = bounded_from_sigma(static_cast<T>(scale * sigma.value));
    const bool inside = x.sigma < edge.sigma && x.complement > edge.complement;
    return {clamp_below(edge, x), static_cast<T>(marginal_column_rate(column)),
            inside ? static_cast<T>(scale * s.derivative * sigma.derivative) : T(0)};
  }

  /// At u2 = 1/2 both differentials may vanish as t does; those of the next number stand for them,
  /// because their quotient is continuous there.
  [[gnu::always_inline]] ConditionalStep conditional_at(const BoundedSlope<T>& x,
                                                        double column) const {
    constexpr double kBeside = 0x1p-26;  // where p = 2 kBeside^2 is a rounding of 1
    const double row = conditional_row(x), place = std::max(column, kBeside);
    const auto v = tables_->conditional.lookup_with_derivative(row, column);
    const double derivative =
        place == column ? v.derivative
                        : tables_->conditional.lookup_with_derivative(row, place).derivative;
    return {static_cast<T>(v.value), static_cast<T>(conditional_column_rate(place) / 2),
            static_cast<T>(derivative)};
  }

  /// The slope (x, scale y), with `scale` times the denominator of x as ConditionalScale gives it.
  /// Where the scale is 0 and y infinite, as at u1 = 0 and u2 = 0 or 1 of Beckmann slopes, the
  /// slope is infinite along x; nowhere else does the least number change a digit of a normal.
  static HomogeneousSlope<T> joined(const SlopeFraction<T>& x, T scale, const SlopeFraction<T>& y) {
    constexpr T kLeast = std::numeric_limits<T>::min();
    return {x.numerator * (y.denominator + kLeast), scale * y.numerator,
            x.denominator * y.denominator};
  }

  /// Whether the map reaches the slope x and the value v. Inverse lookup answers with the end of a
  /// row for what lies beyond it, and the row has another slope there.
  bool reaches(const BoundedSlope<T>& c, const TableColumns<T>& columns, const BoundedSlope<T>& x,
               T v) const {
    const BoundedSlope<T> near_x = columns.marginal < T(1) ? x : marginal_at(c, 1).x;
    const T end = static_cast<T>(tables_->conditional.lookup(conditional_row(x), 1));
    const auto unit = [&](const BoundedSlope<T>& at, T value) {
      const SlopeFraction<T> fraction{at.numerator(), at.denominator()};
      const auto slope = joined(fraction, scale_.at(fraction), conditional_value_inverse(value));
      return normalize_or_up(Vec3<T>{slope.x, slope.y, slope.w});
    };
    const Vec3<T> m = unit(x, v), n = unit(near_x, std::min(v, end));
    return std::abs(m.x - n.x) + std::abs(m.y - n.y) + std::abs(m.z - n.z) <= kRangeSlack<T>;
  }

  std::shared_ptr<const SlopeTables> tables_;
  BoundedSlope<T> support_;
  PairCoordinates coordinates_;
  ConditionalScale<T> scale_;
  T lowest_;  // sigma of the lowest cotangent from which slopes are visible
};

}  // namespace vndf
