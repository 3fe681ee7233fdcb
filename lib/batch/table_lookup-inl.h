// Looking up a quantile table (vndf/table.h): where the rows and the column of each sample lie, the
// blend of the rows, and the cubic along the blend.
//
// A table is not gathered lane by lane: of each sample one short vector, the two neighbouring nodes
// of a row, is loaded from each of the rows around and blended there, and a step of its own turns
// the blends of all samples into four vectors. That takes 4 loads a sample where gathers take 16,
// and is the same on every target.

// Included once for each target: the guard turns over with every one.
#if defined(VNDF_BATCH_TABLE_LOOKUP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef VNDF_BATCH_TABLE_LOOKUP_INL_H
#undef VNDF_BATCH_TABLE_LOOKUP_INL_H
#else
#define VNDF_BATCH_TABLE_LOOKUP_INL_H
#endif

#include <array>
#include <cstddef>
#include <cstdint>

#include <hwy/highway.h>

#include "batch/blocks.h"
#include "batch/vectors-inl.h"
#include "vndf/row_axis.h"
#include "vndf/table.h"

HWY_BEFORE_NAMESPACE();
namespace vndf::batch::HWY_NAMESPACE {
namespace {

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

}  // namespace
}  // namespace vndf::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // guard of the target
