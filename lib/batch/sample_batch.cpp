// The kernels of sample_batch(), compiled once for each target, and their dispatch.
//
// A table is not gathered lane by lane: of each sample one short vector, the four neighbours in a
// row, is loaded from each of the rows around and blended there, and a step of its own turns the
// blends of all samples into four vectors. That takes 4 loads a sample where gathers take 16, and
// is the same on every target.
#include "batch/sample_batch.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>

#include "batch/batch_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "batch/sample_batch.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace vndf::batch::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, kBlock>;
using Ints = hn::RebindToSigned<Floats>;
using V = hn::Vec<Floats>;
using M = hn::Mask<Floats>;
constexpr Floats d;
constexpr Ints di;

V set(float x) { return hn::Set(d, x); }
V set(std::size_t n) { return hn::Set(d, static_cast<float>(n)); }
V load(const Lanes<float>& from, std::size_t i) { return hn::Load(d, from.data() + i); }
void store(V v, Lanes<float>& to, std::size_t i) { hn::Store(v, d, to.data() + i); }
V clamped(V x) { return hn::Min(hn::Max(x, hn::Zero(d)), set(1.0f)); }

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

/// vndf::monotone_cubic.
V tangent(V left, V right) {
  const V central = hn::Mul(set(0.5f), hn::Add(left, right));
  return hn::Max(hn::Zero(d), hn::Min(central, hn::Mul(set(3.0f), hn::Min(left, right))));
}
V monotone_cubic(V w0, V w1, V w2, V w3, V fraction) {
  const V secant = hn::Sub(w2, w1);
  const V m1 = tangent(hn::Sub(w1, w0), secant), m2 = tangent(secant, hn::Sub(w3, w2));
  const V c2 = hn::NegMulAdd(set(2.0f), m1, hn::MulSub(set(3.0f), secant, m2));
  const V c3 = hn::NegMulAdd(set(2.0f), secant, hn::Add(m1, m2));
  return hn::MulAdd(fraction, hn::MulAdd(fraction, hn::MulAdd(fraction, c3, c2), m1), w1);
}

/// The row coordinate of a base coordinate (RowAxis::row).
V row_coordinate(const RowAxis<float>& axis, V base) {
  const auto& knots = axis.bases();
  if (knots.empty()) return base;
  auto segment = hn::Zero(di);
  for (std::size_t k = 1; k + 1 < knots.size(); ++k)
    segment = hn::Sub(segment, hn::VecFromMask(di, hn::RebindMask(di, hn::Ge(base, set(knots[k])))));
  const V below = hn::GatherIndex(d, axis.rows().data(), segment);
  const V above = hn::GatherIndex(d, axis.rows().data() + 1, segment);
  const V rise = hn::Mul(hn::Sub(base, hn::GatherIndex(d, knots.data(), segment)),
                         hn::GatherIndex(d, axis.rows_per_base().data(), segment));
  return hn::Min(hn::Max(hn::Add(below, rise), below), above);
}

/// The place of each sample in a table: where its four values of the first row begin, the weights
/// of the rows and the fraction of its cell. After blend(), its four values.
struct Places {
  Lanes<std::int32_t> row, begin;
  std::array<Lanes<float>, 4> weights;
  Lanes<float> fraction;
  alignas(64) std::array<float, 4 * kBlock> four;
};

/// vndf::weighted_rows.
void place_rows(const QuantileTable& table, V coordinate, Places& places, std::size_t i) {
  const CellVector r = cell_of(coordinate, table.rows() - 1);
  const auto stride = hn::Set(di, static_cast<std::int32_t>(table.columns() + 2));
  if (table.blend() == RowBlend::linear) {
    hn::Store(hn::Mul(r.index, stride), di, places.row.data() + i);
    store(r.fraction, places.weights[1], i);
    return store(hn::Sub(set(1.0f), r.fraction), places.weights[0], i);
  }
  const auto last = hn::Set(di, static_cast<std::int32_t>(table.rows() - 4));
  const auto before = hn::Sub(r.index, hn::Set(di, 1));
  const auto first = hn::Min(hn::Max(before, hn::Zero(di)), last);
  hn::Store(hn::Mul(first, stride), di, places.row.data() + i);
  const V x = hn::Add(hn::ConvertTo(d, hn::Sub(r.index, first)), r.fraction);
  const V x1 = hn::Sub(x, set(1.0f)), x2 = hn::Sub(x, set(2.0f)), x3 = hn::Sub(x, set(3.0f));
  const V low = hn::Mul(x, x1), high = hn::Mul(x2, x3);
  store(hn::Mul(hn::Mul(x1, high), set(-1.0f / 6)), places.weights[0], i);
  store(hn::Mul(hn::Mul(x, high), set(0.5f)), places.weights[1], i);
  store(hn::Mul(hn::Mul(low, x3), set(-0.5f)), places.weights[2], i);
  store(hn::Mul(hn::Mul(low, x2), set(1.0f / 6)), places.weights[3], i);
}

/// The column of each sample in the rows that place_rows() chose.
void place_column(const QuantileTable& table, V coordinate, Places& places,
                           std::size_t i) {
  const CellVector c = cell_of(coordinate, table.columns() - 1);
  hn::Store(hn::Add(c.index, hn::Load(di, places.row.data() + i)), di, places.begin.data() + i);
  store(c.fraction, places.fraction, i);
}

/// The four values of each sample, blended over kRows rows that lie `stride` apart.
template <std::size_t kRows>
void blend_rows(const float* values, std::size_t stride, Places& places) {
  const hn::CappedTag<float, 4> d4;
  for (std::size_t i = 0; i < kBlock; ++i) {
    const float* p = values + places.begin.at[i];
    for (std::size_t k = 0; k < 4; k += hn::Lanes(d4)) {
      auto w = hn::LoadU(d4, p + k);
      if constexpr (kRows > 1) w = hn::Mul(w, hn::Set(d4, places.weights[0].at[i]));
      for (std::size_t r = 1; r < kRows; ++r)
        w = hn::MulAdd(hn::Set(d4, places.weights[r].at[i]), hn::LoadU(d4, p + r * stride + k), w);
      hn::Store(w, d4, &places.four[4 * i + k]);
    }
  }
}

void blend(const QuantileTable& table, Places& places) {
  // A row has one value before it.
  const float* values = table.row(0) - 1;
  const std::size_t stride = table.columns() + 2;
  if (table.rows() == 1) return blend_rows<1>(values, stride, places);
  if (table.blend() == RowBlend::linear) return blend_rows<2>(values, stride, places);
  blend_rows<4>(values, stride, places);
}

/// The values of the table, in [0, 1].
V value(const Places& places, std::size_t i) {
  V w0, w1, w2, w3;
  hn::LoadInterleaved4(d, &places.four[4 * i], w0, w1, w2, w3);
  return clamped(monotone_cubic(w0, w1, w2, w3, load(places.fraction, i)));
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

/// What a block knows of its incident directions (vndf::Incident); the rows are in its Places.
struct Incidents {
  Lanes<float> valid, alpha_x, alpha_y, cos, sin, edge_sigma, edge_complement, ordered_edge;
};

/// vndf::valid.
M valid(V x, V y, V z, V alpha_x, V alpha_y) {
  const V zero = hn::Zero(d), largest = set(std::numeric_limits<float>::max());
  const M direction = hn::And(hn::Ge(z, zero), hn::And(hn::Le(hn::Abs(x), largest),
                                                       hn::Le(hn::Abs(y), largest)));
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

/// Step 1 and the row of the marginal table, as IncidentSampler's.
void stretch(const TabulatedSampler<float>& sampler, DirectionInputs& inputs,
                      std::size_t begin, Incidents& incidents, Places& marginal) {
  const SlopeTables& tables = sampler.tables();
  const float *wi_x = inputs.x.block(begin), *wi_y = inputs.y.block(begin),
              *wi_z = inputs.z.block(begin), *alpha_x = inputs.alpha_x.block(begin),
              *alpha_y = inputs.alpha_y.block(begin);
  const BoundedSlope<float> support = sampler.bounded_support();
  for (std::size_t i = 0; i < kBlock; i += hn::Lanes(d)) {
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
    const BoundedVector edge = {
        hn::IfThenElse(in_reach, hn::Mul(upper, scale), set(support.sigma)),
        hn::IfThenElse(in_reach, complement, set(support.complement))};
    store(edge.sigma, incidents.edge_sigma, i);
    store(edge.complement, incidents.edge_complement, i);
    store(to_order(edge, tables.tail_order).sigma, incidents.ordered_edge, i);
    if (tables.marginal.rows() == 1) continue;
    const V base = hn::Sqrt(hn::Add(complement, complement));
    place_rows(tables.marginal, row_coordinate(sampler.marginal_rows(), base), marginal, i);
  }
}

/// The same incident direction for the whole block.
void repeat(const Incident<float>& incident, std::size_t stride, Incidents& incidents,
            Places& marginal) {
  incidents.valid.at.fill(incident.valid ? 1.0f : 0.0f);
  incidents.alpha_x.at.fill(incident.alpha.x);
  incidents.alpha_y.at.fill(incident.alpha.y);
  incidents.cos.at.fill(incident.phi.cos);
  incidents.sin.at.fill(incident.phi.sin);
  incidents.edge_sigma.at.fill(incident.edge.sigma);
  incidents.edge_complement.at.fill(incident.edge.complement);
  incidents.ordered_edge.at.fill(incident.ordered_edge.sigma);
  marginal.row.at.fill(static_cast<std::int32_t>(incident.rows.first * stride));
  for (std::size_t r = 0; r < 4; ++r) marginal.weights[r].at.fill(incident.rows.weights[r]);
}

/// Everything between a block's incident directions and its normals.
class Sampling {
 public:
  Sampling(const TabulatedSampler<float>& sampler, Samples& samples)
      : sampler_(sampler), tables_(sampler.tables()), samples_(samples) {}

  void block(std::size_t begin, const Incidents& incidents, Places& marginal) {
    place_marginal(samples_.u1.block(begin), marginal);
    blend(tables_.marginal, marginal);
    // 2.a marginal
    if (sampler_.marginal_map().identity()) {
      for (std::size_t i = 0; i < kBlock; i += hn::Lanes(d))
        store(hn::Mul(load(incidents.edge_sigma, i), value(marginal, i)), sigma_, i);
    } else {
      map_marginal(marginal);
    }
    const float* u2 = samples_.u2.block(begin);
    for (std::size_t i = 0; i < kBlock; i += hn::Lanes(d)) place_conditional(incidents, u2, i);
    // 2.b conditional
    blend(tables_.conditional, conditional_);
    normals(begin, incidents);
  }

 private:
  void place_marginal(const float* u1, Places& marginal) {
    for (std::size_t i = 0; i < kBlock; i += hn::Lanes(d))
      place_column(tables_.marginal, marginal_column(inside(hn::LoadU(d, u1 + i))), marginal, i);
  }

  /// sigma_n by the map: its pieces are read as a table is, four coefficients at once.
  void map_marginal(const Places& marginal) {
    const MonotoneMap<float>& map = sampler_.marginal_map();
    for (std::size_t i = 0; i < kBlock; i += hn::Lanes(d)) {
      const CellVector piece = cell_of(value(marginal, i), map.pieces());
      hn::Store(hn::ShiftLeft<2>(piece.index), di, pieces_.begin.data() + i);
      store(piece.fraction, pieces_.fraction, i);
    }
    blend_rows<1>(map.coefficients(), 0, pieces_);
    for (std::size_t i = 0; i < kBlock; i += hn::Lanes(d)) {
      V c0, c1, c2, c3;
      hn::LoadInterleaved4(d, &pieces_.four[4 * i], c0, c1, c2, c3);
      const V f = load(pieces_.fraction, i);
      store(hn::MulAdd(f, hn::MulAdd(f, hn::MulAdd(f, c3, c2), c1), c0), sigma_, i);
    }
  }

  /// The slope x and the place of |y| in the conditional table.
  void place_conditional(const Incidents& incidents, const float* u2, std::size_t i) {
    const V ordered = hn::Min(load(sigma_, i), load(incidents.ordered_edge, i));
    const BoundedVector near =
        from_order({ordered, hn::Sub(set(1.0f), ordered)}, tables_.tail_order);
    const V edge = load(incidents.edge_sigma, i);
    const M inner = hn::Lt(near.sigma, edge);
    const V sigma = hn::IfThenElse(inner, near.sigma, edge);
    const V complement =
        hn::IfThenElse(inner, near.complement, load(incidents.edge_complement, i));
    const V n = hn::Sub(sigma, set(0.5f)), denominator = hn::Mul(sigma, complement);
    store(n, numerator_, i);
    store(denominator, denominator_, i);
    const V u = inside(hn::LoadU(d, u2 + i));
    const V negative = hn::VecFromMask(d, hn::Lt(u, set(0.5f)));
    store(hn::Or(scale(n, denominator), hn::And(negative, hn::SignBit(d))), scale_, i);
    if (tables_.conditional.rows() > 1) {
      // vndf::conditional_base
      const V length = hn::Abs(n), unit = hn::Mul(set(sampler_.conditional_unit()), denominator);
      const V hypotenuse = hn::Sqrt(hn::MulAdd(unit, unit, hn::Mul(n, n)));
      const V base = hn::Sqrt(hn::Div(length, hn::Add(unit, hypotenuse)));
      place_rows(tables_.conditional, row_coordinate(sampler_.conditional_rows(), base),
                 conditional_, i);
    }
    place_column(tables_.conditional, conditional_column(u), conditional_, i);
  }

  /// ConditionalScale::at.
  V scale(V n, V denominator) const {
    const ConditionalScale<float>& s = sampler_.conditional_scale();
    if (std::isinf(s.support)) {
      const V square = hn::Mul(set(s.constant), hn::Mul(denominator, denominator));
      return hn::Sqrt(hn::MulAdd(set(s.quadratic), hn::Mul(n, n), square));
    }
    const V edge = hn::Mul(set(s.support), denominator);
    const V square = hn::Mul(hn::Sub(edge, n), hn::Add(edge, n));
    return hn::Sqrt(hn::Max(hn::Zero(d), square));
  }

  /// Steps 3 to 5.
  void normals(std::size_t begin, const Incidents& incidents) {
    float *out_x = samples_.x.block(begin), *out_y = samples_.y.block(begin),
          *out_z = samples_.z.block(begin);
    for (std::size_t i = 0; i < kBlock; i += hn::Lanes(d)) {
      // vndf::conditional_value_inverse, over the common denominator of x and y
      const V v = value(conditional_, i), one = set(1.0f);
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
      const V square = hn::MulAdd(m_x, m_x, hn::MulAdd(m_y, m_y, hn::Mul(m_z, m_z)));
      // vndf::normalize_or_up
      const V largest = set(std::numeric_limits<float>::max());
      const M is_valid = hn::And(hn::Gt(hn::Mul(square, load(incidents.valid, i)), hn::Zero(d)),
                                 hn::Le(square, largest));
      const V inverse = hn::Div(one, hn::Sqrt(square));
      hn::StoreU(hn::IfThenElseZero(is_valid, hn::Mul(m_x, inverse)), d, out_x + i);
      hn::StoreU(hn::IfThenElseZero(is_valid, hn::Mul(m_y, inverse)), d, out_y + i);
      hn::StoreU(hn::IfThenElse(is_valid, hn::Mul(m_z, inverse), one), d, out_z + i);
    }
    samples_.x.finish(begin);
    samples_.y.finish(begin);
    samples_.z.finish(begin);
  }

  const TabulatedSampler<float>& sampler_;
  const SlopeTables& tables_;
  Samples& samples_;
  Places conditional_{}, pieces_{};
  Lanes<float> sigma_, numerator_, denominator_, scale_;
};

void sample_directions(const TabulatedSampler<float>& sampler, DirectionInputs& inputs,
                                Samples& samples) {
  Sampling sampling(sampler, samples);
  Incidents incidents;
  Places marginal{};
  for (std::size_t begin = 0; begin < samples.size; begin += kBlock) {
    stretch(sampler, inputs, begin, incidents, marginal);
    sampling.block(begin, incidents, marginal);
  }
}

void sample_incident(const IncidentSampler<float>& incident, Samples& samples) {
  Sampling sampling(incident.sampler(), samples);
  Incidents incidents;
  Places marginal{};
  repeat(incident.incident(), incident.sampler().tables().marginal.columns() + 2, incidents,
         marginal);
  for (std::size_t begin = 0; begin < samples.size; begin += kBlock)
    sampling.block(begin, incidents, marginal);
}

}  // namespace
}  // namespace vndf::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vndf {
namespace batch {
namespace {

HWY_EXPORT(sample_directions);
HWY_EXPORT(sample_incident);

/// Throws std::invalid_argument unless the span `name` has the size of wm.x.
void check_size(const char* name, std::size_t size, std::size_t expected) {
  if (size == expected) return;
  throw std::invalid_argument(std::string("sample_batch: the span ") + name + " has " +
                              std::to_string(size) + " values and wm.x has " +
                              std::to_string(expected) + ": give spans of one size");
}

Samples samples_of(std::span<const float> u1, std::span<const float> u2, const NormalSpans& wm) {
  const std::size_t n = wm.x.size();
  check_size("wm.y", wm.y.size(), n);
  check_size("wm.z", wm.z.size(), n);
  check_size("u1", u1.size(), n);
  check_size("u2", u2.size(), n);
  return {n, Input(u1), Input(u2), Output(wm.x), Output(wm.y), Output(wm.z)};
}

void check_directions(const DirectionSpans& wi, std::size_t n) {
  check_size("wi.x", wi.x.size(), n);
  check_size("wi.y", wi.y.size(), n);
  check_size("wi.z", wi.z.size(), n);
}

}  // namespace
}  // namespace batch

void sample_batch(const TabulatedSampler<float>& sampler, const DirectionSpans& wi,
                  const AlphaSpans& alpha, std::span<const float> u1, std::span<const float> u2,
                  const NormalSpans& wm) {
  using namespace batch;
  Samples samples = samples_of(u1, u2, wm);
  check_directions(wi, samples.size);
  check_size("alpha.x", alpha.x.size(), samples.size);
  check_size("alpha.y", alpha.y.size(), samples.size);
  DirectionInputs inputs{Input(wi.x), Input(wi.y), Input(wi.z), Input(alpha.x), Input(alpha.y)};
  HWY_DYNAMIC_DISPATCH(sample_directions)(sampler, inputs, samples);
}

void sample_batch(const TabulatedSampler<float>& sampler, const DirectionSpans& wi,
                  const Alpha<float>& alpha, std::span<const float> u1, std::span<const float> u2,
                  const NormalSpans& wm) {
  using namespace batch;
  Samples samples = samples_of(u1, u2, wm);
  check_directions(wi, samples.size);
  DirectionInputs inputs{Input(wi.x), Input(wi.y), Input(wi.z), Input(alpha.x), Input(alpha.y)};
  HWY_DYNAMIC_DISPATCH(sample_directions)(sampler, inputs, samples);
}

void sample_batch(const IncidentSampler<float>& incident, std::span<const float> u1,
                  std::span<const float> u2, const NormalSpans& wm) {
  using namespace batch;
  Samples samples = samples_of(u1, u2, wm);
  HWY_DYNAMIC_DISPATCH(sample_incident)(incident, samples);
}

}  // namespace vndf
#endif  // HWY_ONCE
