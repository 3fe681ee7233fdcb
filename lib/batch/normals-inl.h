// Steps 2 to 5 of Algorithm 4 for a block of samples whose incident directions are known: the two
// lookups that give a slope, and the normal of the slope.

// Included once for each target: the guard turns over with every one.
#if defined(VNDF_BATCH_NORMALS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef VNDF_BATCH_NORMALS_INL_H
#undef VNDF_BATCH_NORMALS_INL_H
#else
#define VNDF_BATCH_NORMALS_INL_H
#endif

#include <cmath>
#include <cstddef>
#include <limits>

#include <hwy/highway.h>

#include "batch/batch_kernel.h"
#include "batch/blocks.h"
#include "batch/incidents-inl.h"
#include "batch/table_lookup-inl.h"
#include "batch/vectors-inl.h"
#include "vndf/tabulated_sampler.h"

HWY_BEFORE_NAMESPACE();
namespace vndf::batch::HWY_NAMESPACE {
namespace {

/// vndf::marginal_column: t = 1 / (1 + b / a), (a / b)^2 = root of u / (1 - u).
HWY_INLINE V marginal_column(V u) {
  const V one = set(1.0f);
  const V square = hn::Mul(u, inverse_root(hn::Mul(u, hn::Sub(one, u))));
  return hn::Div(one, hn::Add(one, inverse_root(square)));
}

/// vndf::conditional_column of vndf::fold: t = 1 / (1 + a / b), (a / b)^2 = (s + s^2) / p.
HWY_INLINE V conditional_column(V u) {
  const V one = set(1.0f), complement = hn::Sub(one, u);
  const V s = hn::Sqrt(hn::Mul(set(2.0f), hn::Min(u, complement)));
  const V p = hn::Abs(hn::Sub(u, complement)), square = hn::MulAdd(s, s, s);
  return hn::Div(one, hn::MulAdd(square, inverse_root(hn::Mul(square, p)), one));
}

HWY_INLINE BoundedVector from_order(BoundedVector x, int order) {
  for (int n = order; n > 1; n /= 2) {
    const V a = hn::Mul(x.sigma, x.sigma), b = hn::Mul(x.complement, x.complement);
    const V scale = hn::Div(set(1.0f), hn::Add(a, b));
    x = {hn::Mul(a, scale), hn::Mul(b, scale)};
  }
  return x;
}

/// Everything between the incident directions of a block and its normals, in short loops: one that
/// waits for a table or a root then has the next samples at hand.
class Sampling {
 public:
  Sampling(const TabulatedSampler<float>& sampler, Samples& samples)
      : sampler_(sampler), tables_(sampler.tables()), samples_(samples) {}

  void block(std::size_t begin, const Incidents& incidents) {
    const std::size_t n = block_size(begin, samples_.size);
    const float* u2 = samples_.u2.block(begin);
    place_columns(incidents, samples_.u1.block(begin), u2, n);
    // 2.a marginal
    if (sampler_.marginal_map().identity())
      unmapped_marginal(incidents, n);
    else
      mapped_marginal(incidents, n);
    // 2.b conditional
    place_across(incidents, u2, n);
    // 3. rotate, 4. unstretch, 5. compute the normal
    write_normals(incidents, begin, n);
  }

 private:
  /// Columns in both tables. That of the conditional is without the row, which is not known yet.
  void place_columns(const Incidents& incidents, const float* u1, const float* u2, std::size_t n) {
    for (std::size_t i = 0; i < n; i += hn::Lanes(d)) {
      place_column(tables_.marginal, marginal_column(inside(hn::LoadU(d, u1 + i))),
                   hn::Load(di, incidents.rows.begin.data() + i), marginal_, i);
      place_column(tables_.conditional, conditional_column(inside(hn::LoadU(d, u2 + i))),
                   hn::Zero(di), conditional_, i);
    }
  }

  HWY_INLINE V marginal_value(const Incidents& incidents, std::size_t i) const {
    return value(tables_.marginal, load(incidents.rows.fraction, i), marginal_, i);
  }

  void unmapped_marginal(const Incidents& incidents, std::size_t n) {
    for (std::size_t i = 0; i < n; i += hn::Lanes(d))
      store(hn::Mul(load(incidents.edge_sigma, i), marginal_value(incidents, i)), sigma_, i);
  }

  /// sigma_n by the map: its pieces are read as a table is, four coefficients at once.
  void mapped_marginal(const Incidents& incidents, std::size_t n) {
    const MonotoneMap<float>& map = sampler_.marginal_map();
    for (std::size_t i = 0; i < n; i += hn::Lanes(d))
      store(marginal_value(incidents, i), sigma_, i);
    for (std::size_t i = 0; i < n; i += hn::Lanes(d)) {
      const CellVector piece = cell_within(load(sigma_, i), map.pieces());
      hn::Store(hn::ShiftLeft<2>(piece.index), di, pieces_.begin.data() + i);
      store(piece.fraction, pieces_.fraction, i);
    }
    for (std::size_t i = 0; i < n; i += hn::Lanes(d)) {
      const auto [c0, c1, c2, c3] =
          weighted_fours<1>(map.coefficients(), 0, pieces_.begin.data() + i, nullptr);
      const V f = load(pieces_.fraction, i);
      store(hn::MulAdd(f, hn::MulAdd(f, hn::MulAdd(f, c3, c2), c1), c0), sigma_, i);
    }
  }

  /// The slope x, whose scale of y has the sign of y, and the rows of the conditional table.
  void place_across(const Incidents& incidents, const float* u2, std::size_t n) {
    for (std::size_t i = 0; i < n; i += hn::Lanes(d)) {
      const BoundedVector x = marginal_slope(incidents, i);
      const V numerator = hn::Sub(x.sigma, set(0.5f));
      const V denominator = hn::Mul(x.sigma, x.complement);
      store(numerator, numerator_, i);
      store(denominator, denominator_, i);
      const V scale = conditional_scale(numerator, denominator);
      const M is_positive = hn::Ge(hn::LoadU(d, u2 + i), set(0.5f));
      store(hn::IfThenElse(is_positive, scale, hn::Neg(scale)), scale_, i);
      if (tables_.conditional.rows() == 1) continue;
      place_rows(tables_.conditional, conditional_row(numerator, denominator), conditional_rows_,
                 i);
      hn::Store(hn::Add(hn::Load(di, conditional_.begin.data() + i),
                        hn::Load(di, conditional_rows_.begin.data() + i)),
                di, conditional_.begin.data() + i);
    }
  }

  /// TabulatedSampler::sample_marginal, from the value at the order of the table.
  HWY_INLINE BoundedVector marginal_slope(const Incidents& incidents, std::size_t i) const {
    const V one = set(1.0f), sigma = load(sigma_, i);
    BoundedVector x{sigma, hn::Sub(one, sigma)};
    if (tables_.tail_order > 1) {
      const V held = hn::Min(sigma, load(incidents.ordered_edge, i));
      x = from_order({held, hn::Sub(one, held)}, tables_.tail_order);
    }
    // vndf::held_below
    return {hn::Min(x.sigma, load(incidents.edge_sigma, i)),
            hn::Max(x.complement, load(incidents.edge_complement, i))};
  }

  /// ConditionalScale::at.
  HWY_INLINE V conditional_scale(V numerator, V denominator) const {
    const ConditionalScale<float>& s = sampler_.conditional_scale();
    if (std::isinf(s.support)) {
      const V square = hn::Mul(set(s.constant), hn::Mul(denominator, denominator));
      return hn::Sqrt(hn::MulAdd(set(s.quadratic), hn::Mul(numerator, numerator), square));
    }
    const V edge = hn::Mul(set(s.support), denominator);
    const V square = hn::Mul(hn::Sub(edge, numerator), hn::Add(edge, numerator));
    return hn::Sqrt(hn::Max(hn::Zero(d), square));
  }

  /// The row coordinate of vndf::conditional_base.
  HWY_INLINE V conditional_row(V numerator, V denominator) const {
    const V unit = hn::Mul(set(sampler_.conditional_unit()), denominator);
    const V hypotenuse = hn::Sqrt(hn::MulAdd(unit, unit, hn::Mul(numerator, numerator)));
    const V size = hn::Abs(numerator);
    const V base = hn::Mul(size, inverse_root(hn::Mul(size, hn::Add(unit, hypotenuse))));
    return row_coordinate(sampler_.conditional_rows(), base);
  }

  void write_normals(const Incidents& incidents, std::size_t begin, std::size_t n) {
    float *out_x = samples_.x.block(begin), *out_y = samples_.y.block(begin),
          *out_z = samples_.z.block(begin);
    for (std::size_t i = 0; i < n; i += hn::Lanes(d))
      store(value(tables_.conditional, load(conditional_rows_.fraction, i), conditional_, i),
            across_, i);
    for (std::size_t i = 0; i < n; i += hn::Lanes(d)) {
      // vndf::conditional_value_inverse, over the common denominator of x and y
      const V v = load(across_, i), one = set(1.0f);
      const V under = hn::Mul(hn::Sub(one, v), hn::Add(one, v));
      const V slope_x = hn::Mul(load(numerator_, i), under);
      const V slope_y = hn::Mul(load(scale_, i), hn::Add(v, v));
      // 3. rotate, 4. unstretch, 5. compute the normal
      const V cos = load(incidents.cos, i), sin = load(incidents.sin, i);
      const V minus_x = hn::MulSub(sin, slope_y, hn::Mul(cos, slope_x));
      const V minus_y = hn::NegMulSub(sin, slope_x, hn::Mul(cos, slope_y));
      const V m_x = hn::Mul(load(incidents.alpha_x, i), minus_x);
      const V m_y = hn::Mul(load(incidents.alpha_y, i), minus_y);
      const V m_z = hn::Mul(load(denominator_, i), under);
      // vndf::normalize_or_up; a length that inverse_root() cannot tell is none.
      const V square = hn::MulAdd(m_x, m_x, hn::MulAdd(m_y, m_y, hn::Mul(m_z, m_z)));
      const M is_normal = hn::And(hn::Ge(square, set(std::numeric_limits<float>::min())),
                                  hn::Le(square, set(std::numeric_limits<float>::max())));
      const V inverse = inverse_root(square);
      hn::StoreU(hn::IfThenElseZero(is_normal, hn::Mul(m_x, inverse)), d, out_x + i);
      hn::StoreU(hn::IfThenElseZero(is_normal, hn::Mul(m_y, inverse)), d, out_y + i);
      hn::StoreU(hn::IfThenElse(is_normal, hn::Mul(m_z, inverse), one), d, out_z + i);
    }
    samples_.x.finish(begin);
    samples_.y.finish(begin);
    samples_.z.finish(begin);
  }

  const TabulatedSampler<float>& sampler_;
  const SlopeTables& tables_;
  Samples& samples_;
  Places marginal_, pieces_, conditional_;
  Rows conditional_rows_;
  Lanes<float> sigma_, numerator_, denominator_, scale_;
  Lanes<float> across_;  // v = 2 sigma - 1 of |y| / scale
};

}  // namespace
}  // namespace vndf::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // guard of the target
