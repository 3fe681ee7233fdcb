// What a block of samples knows of its incident directions (vndf::Incident): step 1 of Algorithm 4,
// the stretch, and the rows of the marginal table that follow from it.

// Included once for each target: the guard turns over with every one.
#if defined(VNDF_BATCH_INCIDENTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef VNDF_BATCH_INCIDENTS_INL_H
#undef VNDF_BATCH_INCIDENTS_INL_H
#else
#define VNDF_BATCH_INCIDENTS_INL_H
#endif

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

#include <hwy/highway.h>

#include "batch/batch_kernel.h"
#include "batch/blocks.h"
#include "batch/table_lookup-inl.h"
#include "batch/vectors-inl.h"
#include "vndf/incident_sampler.h"
#include "vndf/tabulated_sampler.h"

HWY_BEFORE_NAMESPACE();
namespace vndf::batch::HWY_NAMESPACE {
namespace {

/// A slope in the bounded form (BoundedSlope).
struct BoundedVector {
  V sigma, complement;
};
HWY_INLINE BoundedVector to_order(BoundedVector x, int order) {
  for (int n = order; n > 1; n /= 2) {
    const V a = hn::Sqrt(x.sigma), b = hn::Sqrt(x.complement);
    const V scale = hn::Div(set(1.0f), hn::Add(a, b));
    x = {hn::Mul(a, scale), hn::Mul(b, scale)};
  }
  return x;
}

/// What a block knows of its incident directions (vndf::Incident).
struct Incidents {
  /// Roughness in units in which the mean slope is 1; alpha_x is not a number where an input is
  /// outside its range, which makes the length of the normal none either.
  Lanes<float> alpha_x, alpha_y;
  Lanes<float> cos, sin;
  /// The farthest slope, and its sigma at the order of the table where that is above 1.
  Lanes<float> edge_sigma, edge_complement, ordered_edge;
  Rows rows;
};

/// vndf::valid.
HWY_INLINE M valid(V x, V y, V z, V alpha_x, V alpha_y) {
  const V zero = hn::Zero(d);
  const V sum = hn::Add(hn::Add(hn::Abs(x), hn::Abs(y)), hn::Add(alpha_x, alpha_y));
  const M is_roughness = hn::And(hn::Gt(alpha_x, zero), hn::Gt(alpha_y, zero));
  return hn::And(hn::And(hn::Ge(z, zero), is_roughness),
                 hn::Le(sum, set(std::numeric_limits<float>::max())));
}

struct AzimuthVector {
  V cos, sin, length;
};

/// vndf::azimuth_near_pole. One power of two serves all vectors too short to square.
AzimuthVector azimuth_near_pole(V x, V y) {
  constexpr float kTooShort = 0x1p-50f, kScale = 0x1p100f;
  const V largest = hn::Max(hn::Abs(x), hn::Abs(y));
  const M is_short = hn::Lt(largest, set(kTooShort)), none = hn::Eq(largest, hn::Zero(d));
  const V scale = hn::IfThenElse(is_short, set(kScale), set(1.0f));
  const V sx = hn::Mul(x, scale), sy = hn::Mul(y, scale);
  const V square = hn::MulAdd(sx, sx, hn::Mul(sy, sy)), inverse = inverse_root(square);
  return {hn::IfThenElse(none, set(1.0f), hn::Mul(sx, inverse)),
          hn::IfThenZeroElse(none, hn::Mul(sy, inverse)),
          hn::Mul(hn::Mul(square, inverse), hn::IfThenElse(is_short, set(1 / kScale), set(1.0f)))};
}

/// vndf::azimuth.
HWY_INLINE AzimuthVector azimuth(V x, V y) {
  constexpr float kTooShort = 1e-30f;
  const V square = hn::MulAdd(x, x, hn::Mul(y, y));
  if (!hn::AllFalse(d, hn::Lt(square, set(kTooShort)))) return azimuth_near_pole(x, y);
  const V inverse = inverse_root(square);
  return {hn::Mul(x, inverse), hn::Mul(y, inverse), hn::Mul(square, inverse)};
}

/// Samples of the block that begins at `begin` of `size`, in whole vectors.
std::size_t block_size(std::size_t begin, std::size_t size) {
  const std::size_t lanes = hn::Lanes(d);
  return std::min(kBlock, (size - begin + lanes - 1) / lanes * lanes);
}

/// Step 1 and the row of the marginal table, as IncidentSampler's, for the block of directions
/// that begins at `begin`.
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
    const V unit_x = hn::Mul(ax, set(sampler.mean_slope()));
    const V unit_y = hn::Mul(ay, set(sampler.mean_slope()));
    const M is_valid = valid(x, y, z, ax, ay);
    store(hn::IfThenElse(is_valid, unit_x, hn::NaN(d)), incidents.alpha_x, i);
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
    if (tables.tail_order > 1)
      store(to_order(edge, tables.tail_order).sigma, incidents.ordered_edge, i);
    if (tables.marginal.rows() == 1) {
      hn::Store(hn::Zero(di), di, incidents.rows.begin.data() + i);
      continue;
    }
    const V base = hn::Sqrt(hn::Add(complement, complement));
    place_rows(tables.marginal, row_coordinate(sampler.marginal_rows(), base), incidents.rows, i);
  }
}

/// Puts direction `from` of `one` at samples begin to end - 1 of `all`, whose samples from `end`
/// on may be lost: the directions follow one another.
void repeat(const Incidents& one, std::size_t from, Incidents& all, std::size_t begin,
            std::size_t end, int order) {
  const auto copy = [=](const auto& source, auto& target) HWY_ATTR {
    const hn::Rebind<std::decay_t<decltype(source.at[0])>, Floats> tag;
    const auto value = hn::Set(tag, source.at[from]);
    for (std::size_t i = begin; i < end; i += hn::Lanes(tag))
      hn::StoreU(value, tag, target.data() + i);
  };
  copy(one.alpha_x, all.alpha_x);
  copy(one.alpha_y, all.alpha_y);
  copy(one.cos, all.cos);
  copy(one.sin, all.sin);
  copy(one.edge_sigma, all.edge_sigma);
  copy(one.edge_complement, all.edge_complement);
  if (order > 1) copy(one.ordered_edge, all.ordered_edge);
  copy(one.rows.begin, all.rows.begin);
  copy(one.rows.fraction, all.rows.fraction);
}

/// A block whose samples have all the direction `one`; rows of the table are `stride` numbers
/// apart.
Incidents all_of(const Incident<float>& one, std::size_t stride) {
  Incidents all;
  all.alpha_x.at.fill(one.valid ? one.alpha.x : std::numeric_limits<float>::quiet_NaN());
  all.alpha_y.at.fill(one.alpha.y);
  all.cos.at.fill(one.phi.cos);
  all.sin.at.fill(one.phi.sin);
  all.edge_sigma.at.fill(one.edge.sigma);
  all.edge_complement.at.fill(one.edge.complement);
  all.ordered_edge.at.fill(one.ordered_edge.sigma);
  all.rows.begin.at.fill(static_cast<std::int32_t>(one.rows.first * stride));
  // The weights of four rows give the coordinate itself, for a line is a cubic.
  const auto& w = one.rows.weights;
  all.rows.fraction.at.fill(one.rows.count == 4 ? w[2] - w[0] + 2 * w[3] : w[1]);
  return all;
}

}  // namespace
}  // namespace vndf::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // guard of the target
