// The kernels of sample_batch(), compiled once for each target, and their dispatch.
//
// A table is not gathered lane by lane: of each sample one short vector, the two neighbouring nodes
// of a row, is loaded from each of the rows around and blended there, and a step of its own turns
// the blends of all samples into four vectors. That takes 4 loads a sample where gathers take 16,
// and is the same on every target.
#include "batch/sample_batch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "batch/batch_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "batch/sample_batch.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace vndf::batch::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, kMaxLanes>;
using Ints = hn::RebindToSigned<Floats>;
using V = hn::Vec<Floats>;
using M = hn::Mask<Floats>;
constexpr Floats d;
constexpr Ints di;

V set(float x) {
  return hn::Set(d, x);
}
V set(std::size_t n) {
  return hn::Set(d, static_cast<float>(n));
}
V load(const Lanes<float>& from, std::size_t i) {
  return hn::Load(d, from.data() + i);
}
void store(V v, Lanes<float>& to, std::size_t i) {
  hn::Store(v, d, to.data() + i);
}
V clamped(V x) {
  return hn::Min(hn::Max(x, hn::Zero(d)), set(1.0f));
}

/// The cell of a coordinate among equidistant nodes (vndf::cell_of): not a number goes to 0.
struct CellVector {
  hn::Vec<Ints> index;
  V fraction;
};
CellVector cell_of(V coordinate, std::size_t cells) {
  const V scaled = hn::IfThenElseZero(hn::Gt(coordinate, hn::Zero(d)),
                                      hn::Min(hn::Mul(coordinate, set(cells)), set(cells)));
  const auto index =
      hn::Min(hn::ConvertTo(di, scaled), hn::Set(di, static_cast<std::int32_t>(cells - 1)));
  return {index, hn::Sub(scaled, hn::ConvertTo(d, index))};
}

/// vndf::hermite_piece, at a fraction of the piece.
V hermite(V v0, V t0, V v1, V t1, V fraction) {
  const V secant = hn::Sub(v1, v0);
  const V c3 = hn::NegMulAdd(set(2.0f), secant, hn::Add(t0, t1));
  const V c2 = hn::Sub(hn::Sub(secant, t0), c3);
  return hn::MulAdd(fraction, hn::MulAdd(fraction, hn::MulAdd(fraction, c3, c2), t0), v0);
}

/// The row coordinate of a base coordinate (RowAxis::row).
V row_coordinate(const RowAxis<float>& axis, V base) {
  const auto& knots = axis.bases();
  if (knots.empty()) return base;
  auto segment = hn::Zero(di);
  for (std::size_t k = 1; k + 1 < knots.size(); ++k)
    segment =
        hn::Sub(segment, hn::VecFromMask(di, hn::RebindMask(di, hn::Ge(base, set(knots[k])))));
  const V below = hn::GatherIndex(d, axis.rows().data(), segment);
  const V above = hn::GatherIndex(d, axis.rows().data() + 1, segment);
  const V rise = hn::Mul(hn::Sub(base, hn::GatherIndex(d, knots.data(), segment)),
                         hn::GatherIndex(d, axis.rows_per_base().data(), segment));
  return hn::Min(hn::Max(hn::Add(below, rise), below), above);
}

/// Where the first row around each sample begins in a table, and the weights of the rows.
struct Rows {
  Lanes<std::int32_t> begin;
  std::array<Lanes<float>, 4> weights;
};

/// The place of each sample in its rows: where its four values begin in the first, and the fraction
/// of its cell. After blend(), the four values, blended.
struct Places {
  Lanes<std::int32_t> begin;
  Lanes<float> fraction;
  alignas(64) std::array<float, 4 * kBlock> four;
};

/// vndf::weighted_rows.
void place_rows(const QuantileTable& table, V coordinate, Rows& rows, std::size_t i) {
  if (table.rows() == 1) return hn::Store(hn::Zero(di), di, rows.begin.data() + i);
  const auto stride = hn::Set(di, static_cast<std::int32_t>(2 * table.columns()));
  if (table.blend() == RowBlend::linear) {
    const CellVector r = cell_of(coordinate, table.rows() - 1);
    hn::Store(hn::Mul(r.index, stride), di, rows.begin.data() + i);
    store(r.fraction, rows.weights[1], i);
    return store(hn::Sub(set(1.0f), r.fraction), rows.weights[0], i);
  }
  // vndf::lagrange_rows
  const V last = set(table.rows() - 1);
  const V scaled =
      hn::IfThenElseZero(hn::Gt(coordinate, hn::Zero(d)), hn::Min(hn::Mul(coordinate, last), last));
  const auto second =
      hn::ConvertTo(di, hn::Max(hn::Min(scaled, hn::Sub(last, set(2.0f))), set(1.0f)));
  hn::Store(hn::Mul(hn::Sub(second, hn::Set(di, 1)), stride), di, rows.begin.data() + i);
  const V x1 = hn::Sub(scaled, hn::ConvertTo(d, second));
  const V x = hn::Add(x1, set(1.0f)), x2 = hn::Sub(x1, set(1.0f)), x3 = hn::Sub(x1, set(2.0f));
  const V low = hn::Mul(x, x1), high = hn::Mul(x2, x3);
  store(hn::Mul(hn::Mul(x1, high), set(-1.0f / 6)), rows.weights[0], i);
  store(hn::Mul(hn::Mul(x, high), set(0.5f)), rows.weights[1], i);
  store(hn::Mul(hn::Mul(low, x3), set(-0.5f)), rows.weights[2], i);
  store(hn::Mul(hn::Mul(low, x2), set(1.0f / 6)), rows.weights[3], i);
}

/// The column of each sample in the rows that place_rows() chose.
void place_column(const QuantileTable& table, V coordinate, const Rows& rows, Places& places,
                  std::size_t i) {
  const CellVector c = cell_of(coordinate, table.columns() - 1);
  const auto in_row = hn::ShiftLeft<1>(c.index);  // a node is two numbers
  hn::Store(hn::Add(in_row, hn::Load(di, rows.begin.data() + i)), di, places.begin.data() + i);
  store(c.fraction, places.fraction, i);
}

/// The four values of samples 0 to n - 1, blended over kRows rows that lie `stride` apart.
template <std::size_t kRows>
void blend_rows(const float* values, std::size_t stride, const Rows& rows, Places& places,
                std::size_t n) {
  const hn::CappedTag<float, 4> d4;
  for (std::size_t i = 0; i < n; ++i) {
    const float* p = values + places.begin.at[i];
    for (std::size_t k = 0; k < 4; k += hn::Lanes(d4)) {
      auto w = hn::LoadU(d4, p + k);
      if constexpr (kRows > 1) w = hn::Mul(w, hn::Set(d4, rows.weights[0].at[i]));
      for (std::size_t r = 1; r < kRows; ++r)
        w = hn::MulAdd(hn::Set(d4, rows.weights[r].at[i]), hn::LoadU(d4, p + r * stride + k), w);
      hn::Store(w, d4, &places.four[4 * i + k]);
    }
  }
}

void blend(const QuantileTable& table, const Rows& rows, Places& places, std::size_t n) {
  const float* values = &table.row(0)->value;
  const std::size_t stride = 2 * table.columns();
  if (table.rows() == 1) return blend_rows<1>(values, stride, rows, places, n);
  if (table.blend() == RowBlend::linear) return blend_rows<2>(values, stride, rows, places, n);
  blend_rows<4>(values, stride, rows, places, n);
}

/// The values of the table, in [0, 1].
V value(const QuantileTable& table, const Places& places, std::size_t i) {
  V v0, t0, v1, t1;
  hn::LoadInterleaved4(d, &places.four[4 * i], v0, t0, v1, t1);
  if (table.rows() > 1 && table.blend() == RowBlend::cubic) {  // vndf::with_limited_tangents
    const V most = hn::Mul(set(3.0f), hn::Sub(v1, v0));
    t0 = hn::Max(hn::Min(t0, most), hn::Zero(d));
    t1 = hn::Max(hn::Min(t1, most), hn::Zero(d));
  }
  return clamped(hermite(v0, t0, v1, t1, load(places.fraction, i)));
}

/// u in [0, 1]; not a number becomes 0.
V inside(V u) {
  return hn::IfThenElseZero(hn::Gt(u, hn::Zero(d)), hn::Min(u, set(1.0f)));
}

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

/// A slope in the bounded form (BoundedSlope).
struct BoundedVector {
  V sigma, complement;
};
BoundedVector to_order(BoundedVector x, int order) {
  for (int n = order; n > 1; n /= 2) {
    const V a = hn::Sqrt(x.sigma), b = hn::Sqrt(x.complement);
    const V scale = hn::Div(set(1.0f), hn::Add(a, b));
    x = {hn::Mul(a, scale), hn::Mul(b, scale)};
  }
  return x;
}
BoundedVector from_order(BoundedVector x, int order) {
  for (int n = order; n > 1; n /= 2) {
    const V a = hn::Mul(x.sigma, x.sigma), b = hn::Mul(x.complement, x.complement);
    const V scale = hn::Div(set(1.0f), hn::Add(a, b));
    x = {hn::Mul(a, scale), hn::Mul(b, scale)};
  }
  return x;
}

/// What a block knows of its incident directions (vndf::Incident).
struct Incidents {
  Lanes<float> valid, alpha_x, alpha_y, cos, sin, edge_sigma, edge_complement, ordered_edge;
  Rows rows;
};

/// vndf::valid.
M valid(V x, V y, V z, V alpha_x, V alpha_y) {
  const V zero = hn::Zero(d), largest = set(std::numeric_limits<float>::max());
  const M direction =
      hn::And(hn::Ge(z, zero), hn::And(hn::Le(hn::Abs(x), largest), hn::Le(hn::Abs(y), largest)));
  const M along_x = hn::And(hn::Gt(alpha_x, zero), hn::Le(alpha_x, largest));
  const M along_y = hn::And(hn::Gt(alpha_y, zero), hn::Le(alpha_y, largest));
  return hn::And(direction, hn::And(along_x, along_y));
}

struct AzimuthVector {
  V cos, sin, length;
};

/// vndf::azimuth. One power of two serves all vectors too short to square.
AzimuthVector azimuth(V x, V y) {
  constexpr float kTooShort = 0x1p-50f, kScale = 0x1p100f;
  const V largest = hn::Max(hn::Abs(x), hn::Abs(y));
  const M is_short = hn::Lt(largest, set(kTooShort));
  const V scale = hn::IfThenElse(is_short, set(kScale), set(1.0f));
  const V sx = hn::Mul(x, scale), sy = hn::Mul(y, scale);
  const V length = hn::Sqrt(hn::MulAdd(sx, sx, hn::Mul(sy, sy)));
  const M none = hn::Eq(largest, hn::Zero(d));
  const V inverse = hn::Div(set(1.0f), length);
  return {hn::IfThenElse(none, set(1.0f), hn::Mul(sx, inverse)),
          hn::IfThenZeroElse(none, hn::Mul(sy, inverse)),
          hn::Mul(length, hn::IfThenElse(is_short, set(1 / kScale), set(1.0f)))};
}

/// Samples of the block that begins at `begin` of `size`, in whole vectors.
std::size_t block_size(std::size_t begin, std::size_t size) {
  const std::size_t lanes = hn::Lanes(d);
  return std::min(kBlock, (size - begin + lanes - 1) / lanes * lanes);
}

/// Step 1 and the row of the marginal table, as IncidentSampler's, for the block of directions that
/// begins at `begin`.
void stretch(const TabulatedSampler<float>& sampler, DirectionInputs& inputs, std::size_t begin,
             Incidents& incidents) {
  const SlopeTables& tables = sampler.tables();
  const float *wi_x = inputs.x.block(begin), *wi_y = inputs.y.block(begin),
              *wi_z = inputs.z.block(begin), *alpha_x = inputs.alpha_x.block(begin),
              *alpha_y = inputs.alpha_y.block(begin);
  const BoundedSlope<float> support = sampler.bounded_support();
  const std::size_t n = block_size(begin, inputs.size);
  for (std::size_t i = 0; i < n; i += hn::Lanes(d)) {
    const V x = hn::LoadU(d, wi_x + i), y = hn::LoadU(d, wi_y + i), z = hn::LoadU(d, wi_z + i);
    const V ax = hn::LoadU(d, alpha_x + i), ay = hn::LoadU(d, alpha_y + i);
    store(hn::IfThenElseZero(valid(x, y, z, ax, ay), set(1.0f)), incidents.valid, i);
    const V unit_x = hn::Mul(ax, set(sampler.mean_slope()));
    const V unit_y = hn::Mul(ay, set(sampler.mean_slope()));
    store(unit_x, incidents.alpha_x, i);
    store(unit_y, incidents.alpha_y, i);
    const AzimuthVector phi = azimuth(hn::Mul(unit_x, x), hn::Mul(unit_y, y));
    store(phi.cos, incidents.cos, i);
    store(phi.sin, incidents.sin, i);
    // vndf::bounded_cotangent
    const V upper = hn::Add(z, hn::Sqrt(hn::MulAdd(z, z, hn::Mul(phi.length, phi.length))));
    const V scale = hn::Div(set(1.0f), hn::Add(upper, phi.length));
    const V complement = hn::Mul(phi.length, scale);
    const M in_reach = hn::Gt(complement, set(support.complement));
    const BoundedVector edge = {hn::IfThenElse(in_reach, hn::Mul(upper, scale), set(support.sigma)),
                                hn::IfThenElse(in_reach, complement, set(support.complement))};
    store(edge.sigma, incidents.edge_sigma, i);
    store(edge.complement, incidents.edge_complement, i);
    store(to_order(edge, tables.tail_order).sigma, incidents.ordered_edge, i);
    const V base = hn::Sqrt(hn::Add(complement, complement));
    place_rows(tables.marginal, row_coordinate(sampler.marginal_rows(), base), incidents.rows, i);
  }
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

/// Puts direction `from` of `one` at samples begin to end - 1 of `all`, whose samples from `end` on
/// may be lost: the directions follow one another.
void repeat(const Incidents& one, std::size_t from, Incidents& all, std::size_t begin,
            std::size_t end) {
  const auto copy = [=](const auto& source, auto& target) HWY_ATTR {
    const hn::Rebind<std::decay_t<decltype(source.at[0])>, Floats> tag;
    const auto value = hn::Set(tag, source.at[from]);
    for (std::size_t i = begin; i < end; i += hn::Lanes(tag))
      hn::StoreU(value, tag, target.data() + i);
  };
  copy(one.valid, all.valid);
  copy(one.alpha_x, all.alpha_x);
  copy(one.alpha_y, all.alpha_y);
  copy(one.cos, all.cos);
  copy(one.sin, all.sin);
  copy(one.edge_sigma, all.edge_sigma);
  copy(one.edge_complement, all.edge_complement);
  copy(one.ordered_edge, all.ordered_edge);
  copy(one.rows.begin, all.rows.begin);
  for (std::size_t r = 0; r < 4; ++r) copy(one.rows.weights[r], all.rows.weights[r]);
}

void sample_directions(const TabulatedSampler<float>& sampler, DirectionInputs& inputs,
                       Samples& samples) {
  Sampling sampling(sampler, samples);
  Incidents directions;
  for (std::size_t begin = 0; begin < samples.size; begin += kBlock) {
    stretch(sampler, inputs, begin, directions);
    sampling.block(begin, directions);
  }
}

/// The same with several samples for each direction: a block of directions serves several blocks of
/// samples, in which each direction is repeated.
void sample_repeated_directions(const TabulatedSampler<float>& sampler, DirectionInputs& inputs,
                                Samples& samples) {
  Sampling sampling(sampler, samples);
  Incidents directions, repeated;
  const std::size_t each = inputs.per_direction;
  for (std::size_t begin = 0, stretched = 0; begin < samples.size; begin += kBlock) {
    const std::size_t end = std::min(begin + kBlock, samples.size);
    for (std::size_t i = begin; i < end;) {
      const std::size_t direction = i / each, next = std::min((direction + 1) * each, end);
      if (direction == stretched) {
        stretch(sampler, inputs, direction, directions);
        stretched += kBlock;
      }
      repeat(directions, direction % kBlock, repeated, i - begin, next - begin);
      i = next;
    }
    sampling.block(begin, repeated);
  }
}

void sample_incident(const IncidentSampler<float>& sampler, Samples& samples) {
  const Incident<float>& incident = sampler.incident();
  const std::size_t stride = 2 * sampler.sampler().tables().marginal.columns();
  Incidents all;
  all.valid.at.fill(incident.valid ? 1.0f : 0.0f);
  all.alpha_x.at.fill(incident.alpha.x);
  all.alpha_y.at.fill(incident.alpha.y);
  all.cos.at.fill(incident.phi.cos);
  all.sin.at.fill(incident.phi.sin);
  all.edge_sigma.at.fill(incident.edge.sigma);
  all.edge_complement.at.fill(incident.edge.complement);
  all.ordered_edge.at.fill(incident.ordered_edge.sigma);
  all.rows.begin.at.fill(static_cast<std::int32_t>(incident.rows.first * stride));
  for (std::size_t r = 0; r < 4; ++r) all.rows.weights[r].at.fill(incident.rows.weights[r]);
  Sampling sampling(sampler.sampler(), samples);
  for (std::size_t begin = 0; begin < samples.size; begin += kBlock) sampling.block(begin, all);
}

}  // namespace
}  // namespace vndf::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vndf {
namespace batch {
namespace {

HWY_EXPORT(sample_directions);
HWY_EXPORT(sample_repeated_directions);
HWY_EXPORT(sample_incident);

/// Throws std::invalid_argument unless the span `name` has `expected` values.
void check_size(const char* name, std::size_t size, std::size_t expected) {
  if (size == expected) return;
  throw std::invalid_argument(std::string("sample_batch: the span ") + name + " has " +
                              std::to_string(size) + " values where wm.x asks for " +
                              std::to_string(expected) +
                              "; give u1, u2 and wm one size, that of wi and alpha times the "
                              "samples per direction");
}

Samples samples_of(std::span<const float> u1, std::span<const float> u2, const NormalSpans& wm) {
  const std::size_t n = wm.x.size();
  check_size("wm.y", wm.y.size(), n);
  check_size("wm.z", wm.z.size(), n);
  check_size("u1", u1.size(), n);
  check_size("u2", u2.size(), n);
  return {n, Input(u1), Input(u2), Output(wm.x), Output(wm.y), Output(wm.z)};
}

/// Directions that `samples` normals need.
std::size_t directions_of(const DirectionSpans& wi, std::size_t samples,
                          std::size_t per_direction) {
  if (per_direction == 0 || samples % per_direction != 0)
    throw std::invalid_argument("sample_batch: wm.x has " + std::to_string(samples) +
                                " values, not a multiple of the " + std::to_string(per_direction) +
                                " samples per direction; give each direction as many, 1 or more");
  const std::size_t n = samples / per_direction;
  check_size("wi.x", wi.x.size(), n);
  check_size("wi.y", wi.y.size(), n);
  check_size("wi.z", wi.z.size(), n);
  return n;
}

void dispatch(const TabulatedSampler<float>& sampler, DirectionInputs& inputs, Samples& samples) {
  if (inputs.per_direction == 1)
    HWY_DYNAMIC_DISPATCH(sample_directions)(sampler, inputs, samples);
  else
    HWY_DYNAMIC_DISPATCH(sample_repeated_directions)(sampler, inputs, samples);
}

}  // namespace
}  // namespace batch

void sample_batch(const TabulatedSampler<float>& sampler, const DirectionSpans& wi,
                  const AlphaSpans& alpha, std::span<const float> u1, std::span<const float> u2,
                  const NormalSpans& wm, std::size_t per_direction) {
  using namespace batch;
  Samples samples = samples_of(u1, u2, wm);
  const std::size_t n = directions_of(wi, samples.size, per_direction);
  check_size("alpha.x", alpha.x.size(), n);
  check_size("alpha.y", alpha.y.size(), n);
  DirectionInputs inputs{n,           per_direction,  Input(wi.x),   Input(wi.y),
                         Input(wi.z), Input(alpha.x), Input(alpha.y)};
  dispatch(sampler, inputs, samples);
}

void sample_batch(const TabulatedSampler<float>& sampler, const DirectionSpans& wi,
                  const Alpha<float>& alpha, std::span<const float> u1, std::span<const float> u2,
                  const NormalSpans& wm, std::size_t per_direction) {
  using namespace batch;
  Samples samples = samples_of(u1, u2, wm);
  const std::size_t n = directions_of(wi, samples.size, per_direction);
  DirectionInputs inputs{n,           per_direction,  Input(wi.x),   Input(wi.y),
                         Input(wi.z), Input(alpha.x), Input(alpha.y)};
  dispatch(sampler, inputs, samples);
}

void sample_batch(const IncidentSampler<float>& incident, std::span<const float> u1,
                  std::span<const float> u2, const NormalSpans& wm) {
  using namespace batch;
  Samples samples = samples_of(u1, u2, wm);
  HWY_DYNAMIC_DISPATCH(sample_incident)(incident, samples);
}

}  // namespace vndf
#endif  // HWY_ONCE
