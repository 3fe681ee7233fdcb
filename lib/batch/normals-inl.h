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

/// 1 / (1 + root of `ratio`): the column coordinates a / (a + b), with ratio = (b / a)^2.
V column_of(V ratio) {
  return hn::Div(set(1.0f), hn::Add(set(1.0f), hn::Sqrt(ratio)));
}

/// vndf::marginal_column.
V marginal_column(V u) {
  return column_of(hn::Sqrt(hn::Div(hn::Sub(set(1.0f), u), u)));
}

/// vndf::conditional_column of vndf::fold: a^2 = 1 - s = p / (1 + s), b^2 = s reversed.
V conditional_column(V u) {
  const V complement = hn::Sub(set(1.0f), u);
  const V s = hn::Sqrt(hn::Mul(set(2.0f), hn::Min(u, complement)));
  const V p = hn::Abs(hn::Sub(u, complement));
  return column_of(hn::Div(hn::MulAdd(s, s, s), p));
}

BoundedVector from_order(BoundedVector x, int order) {
  for (int n = order; n > 1; n /= 2) {
    const V a = hn::Mul(x.sigma, x.sigma), b = hn::Mul(x.complement, x.complement);
    const V scale = hn::Div(set(1.0f), hn::Add(a, b));
    x = {hn::Mul(a, scale), hn::Mul(b, scale)};
  }
  return x;
}

/// Everything between the incident directions of a block and its normals.
class Sampling {
 public:
  Sampling(const TabulatedSampler<float>& sampler, Samples& samples)
      : sampler_(sampler), tables_(sampler.tables()), samples_(samples) {}

  void block(std::size_t begin, const Incidents& incidents) {
    const std::size_t n = block_size(begin, samples_.size);
    // 2.a marginal
    place_marginal(incidents, samples_.u1.block(begin), n);
    blend(tables_.marginal, incidents.rows, marginal_, n);
    if (sampler_.marginal_map().identity())
      unmapped_marginal(incidents, n);
    else
      mapped_marginal(n);
    // 2.b conditional
    place_conditional(incidents, samples_.u2.block(begin), n);
    blend(tables_.conditional, conditional_rows_, conditional_, n);
    // 3. rotate, 4. unstretch, 5. compute the normal
    write_normals(incidents, begin, n);
  }

 private:
  void place_marginal(const Incidents& incidents, const float* u1, std::size_t n) {
    for (std::size_t i = 0; i < n; i += hn::Lanes(d))
      place_column(tables_.marginal, marginal_column(inside(hn::LoadU(d, u1 + i))), incidents.rows,
                   marginal_, i);
  }

  void unmapped_marginal(const Incidents& incidents, std::size_t n) {
    for (std::size_t i = 0; i < n; i += hn::Lanes(d))
      store(hn::Mul(load(incidents.edge_sigma, i), value(tables_.marginal, marginal_, i)), sigma_,
            i);
  }

  /// sigma_n by the map: its pieces are read as a table is, four coefficients at once.
  void mapped_marginal(std::size_t n) {
    const MonotoneMap<float>& map = sampler_.marginal_map();
    for (std::size_t i = 0; i < n; i += hn::Lanes(d)) {
      const CellVector piece = cell_of(value(tables_.marginal, marginal_, i), map.pieces());
      hn::Store(hn::ShiftLeft<2>(piece.index), di, pieces_.begin.data() + i);
      store(piece.fraction, pieces_.fraction, i);
    }
    blend_rows<1>(map.coefficients(), 0, {}, pieces_, n);
    for (std::size_t i = 0; i < n; i += hn::Lanes(d)) {
      V c0, c1, c2, c3;
      hn::LoadInterleaved4(d, &pieces_.four[4 * i], c0, c1, c2, c3);
      const V f = load(pieces_.fraction, i);
      store(hn::MulAdd(f, hn::MulAdd(f, hn::MulAdd(f, c3, c2), c1), c0), sigma_, i);
    }
  }

  /// The slope x, whose scale of y has the sign of y, and the place of |y| in its table.
  void place_conditional(const Incidents& incidents, const float* u2, std::size_t n) {
    for (std::size_t i = 0; i < n; i += hn::Lanes(d)) {
      const BoundedVector x = marginal_slope(incidents, i);
      const V numerator = hn::Sub(x.sigma, set(0.5f));
      const V denominator = hn::Mul(x.sigma, x.complement);
      store(numerator, numerator_, i);
      store(denominator, denominator_, i);
      const V u = inside(hn::LoadU(d, u2 + i));
      const V scale = conditional_scale(numerator, denominator);
      store(hn::IfThenElse(hn::Lt(u, set(0.5f)), hn::Neg(scale), scale), scale_, i);
      const V row =
          tables_.conditional.rows() > 1 ? conditional_row(numerator, denominator) : hn::Zero(d);
      place_rows(tables_.conditional, row, conditional_rows_, i);
      place_column(tables_.conditional, conditional_column(u), conditional_rows_, conditional_, i);
    }
  }

  /// TabulatedSampler::sample_marginal, from the value at the order of the table.
  BoundedVector marginal_slope(const Incidents& incidents, std::size_t i) const {
    const V sigma = hn::Min(load(sigma_, i), load(incidents.ordered_edge, i));
    const BoundedVector x = from_order({sigma, hn::Sub(set(1.0f), sigma)}, tables_.tail_order);
    const BoundedVector edge{load(incidents.edge_sigma, i), load(incidents.edge_complement, i)};
    // vndf::held_below
    return {hn::Min(x.sigma, edge.sigma), hn::Max(x.complement, edge.complement)};
  }

  /// ConditionalScale::at.
  V conditional_scale(V numerator, V denominator) const {
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
  V conditional_row(V numerator, V denominator) const {
    const V unit = hn::Mul(set(sampler_.conditional_unit()), denominator);
    const V hypotenuse = hn::Sqrt(hn::MulAdd(unit, unit, hn::Mul(numerator, numerator)));
    const V base = hn::Sqrt(hn::Div(hn::Abs(numerator), hn::Add(unit, hypotenuse)));
    return row_coordinate(sampler_.conditional_rows(), base);
  }

  void write_normals(const Incidents& incidents, std::size_t begin, std::size_t n) {
    float *out_x = samples_.x.block(begin), *out_y = samples_.y.block(begin),
          *out_z = samples_.z.block(begin);
    for (std::size_t i = 0; i < n; i += hn::Lanes(d)) {
      // vndf::conditional_value_inverse, over the common denominator of x and y
      const V v = value(tables_.conditional, conditional_, i), one = set(1.0f);
      const V under = hn::Mul(hn::Sub(one, v), hn::Add(one, v));
      const V slope_x = hn::Mul(load(numerator_, i), under);
      const V slope_y = hn::Mul(load(scale_, i), hn::Add(v, v));
      // 3. rotate
      const V cos = load(incidents.cos, i), sin = load(incidents.sin, i);
      const V x = hn::MulSub(cos, slope_x, hn::Mul(sin, slope_y));
      const V y = hn::MulAdd(sin, slope_x, hn::Mul(cos, slope_y));
      // 4. unstretch, 5. compute the normal
      const V m_x = hn::Neg(hn::Mul(load(incidents.alpha_x, i), x));
      const V m_y = hn::Neg(hn::Mul(load(incidents.alpha_y, i), y));
      const V m_z = hn::Mul(load(denominator_, i), under);
      // vndf::normalize_or_up
      const V square = hn::MulAdd(m_x, m_x, hn::MulAdd(m_y, m_y, hn::Mul(m_z, m_z)));
      const M has_length = hn::And(hn::Gt(square, hn::Zero(d)),
                                   hn::Le(square, set(std::numeric_limits<float>::max())));
      const M is_normal = hn::And(has_length, hn::Eq(load(incidents.valid, i), one));
      const V inverse = hn::Div(one, hn::Sqrt(square));
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
};

}  // namespace
}  // namespace vndf::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // guard of the target
