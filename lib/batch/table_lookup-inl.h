// Looking up a quantile table (vndf/table.h): where the rows and the column of each sample lie, the
// blend of the rows, and the cubic along the blend.
//
// A table is not gathered lane by lane: of each sample one short vector, the two neighbouring nodes
// of a row, is loaded from each of the rows around. Four lanes of a vector hold one sample then,
// the rows are blended so, and a transposition puts the samples side by side. That takes 4 loads a
// sample where gathers take 16.

// Included once for each target: the guard turns over with every one.
#if defined(VNDF_BATCH_TABLE_LOOKUP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef VNDF_BATCH_TABLE_LOOKUP_INL_H
#undef VNDF_BATCH_TABLE_LOOKUP_INL_H
#else
#define VNDF_BATCH_TABLE_LOOKUP_INL_H
#endif

#include <cstddef>
#include <cstdint>

#include <hwy/highway.h>

#include "batch/blocks.h"
#include "batch/vectors-inl.h"
#include "vndf/cubic_piece.h"
#include "vndf/row_axis.h"
#include "vndf/table.h"

HWY_BEFORE_NAMESPACE();
namespace vndf::batch::HWY_NAMESPACE {
namespace {

/// A cell among equidistant nodes, and the fraction of it.
struct CellVector {
  hn::Vec<Ints> index;
  V fraction;
};

/// The cell, from `first` to `last`, of a coordinate in [0, 1] (vndf::cell_of), but that a
/// coordinate within a rounding of a node may go to either side of it.
HWY_INLINE CellVector cell_within(V coordinate, std::size_t cells, std::size_t first,
                                  std::size_t last) {
  // Numbers from 2^23 to 2^24 are whole and end with their own bits: adding 3 2^22 rounds.
  constexpr float kWhole = 0x1.8p23f;
  const V nearest = hn::Add(hn::MulSub(coordinate, set(cells), set(0.5f)), set(kWhole));
  V whole = hn::Min(nearest, hn::Add(set(last), set(kWhole)));
  if (first > 0) whole = hn::Max(whole, hn::Add(set(first), set(kWhole)));
  return {hn::Sub(hn::BitCast(di, whole), hn::BitCast(di, set(kWhole))),
          hn::MulSub(coordinate, set(cells), hn::Sub(whole, set(kWhole)))};
}
HWY_INLINE CellVector cell_within(V coordinate, std::size_t cells) {
  return cell_within(coordinate, cells, 0, cells - 1);
}

/// vndf::hermite_piece, at a fraction of the piece.
HWY_INLINE V hermite(V v0, V t0, V v1, V t1, V fraction) {
  const V secant = hn::Sub(v1, v0);
  const V c3 = hn::NegMulAdd(set(2.0f), secant, hn::Add(t0, t1));
  const V c2 = hn::Sub(hn::Sub(secant, t0), c3);
  return hn::MulAdd(fraction, hn::MulAdd(fraction, hn::MulAdd(fraction, c3, c2), t0), v0);
}

/// values[segment], of which there is one alone where `is_alone`: no gather is needed then.
HWY_INLINE V of_segment(const float* values, hn::Vec<Ints> segment, bool is_alone) {
  return is_alone ? set(*values) : hn::GatherIndex(d, values, segment);
}

/// The row coordinate of a base coordinate (RowAxis::row).
HWY_INLINE V row_coordinate(const RowAxis<float>& axis, V base) {
  const auto& knots = axis.bases();
  if (knots.empty()) return base;
  const bool is_alone = knots.size() == 2;
  auto segment = hn::Zero(di);
  for (std::size_t k = 1; k + 1 < knots.size(); ++k)
    segment =
        hn::Sub(segment, hn::VecFromMask(di, hn::RebindMask(di, hn::Ge(base, set(knots[k])))));
  const V below = of_segment(axis.rows().data(), segment, is_alone);
  const V above = of_segment(axis.rows().data() + 1, segment, is_alone);
  const V rise = hn::Mul(hn::Sub(base, of_segment(knots.data(), segment, is_alone)),
                         of_segment(axis.rows_per_base().data(), segment, is_alone));
  return hn::Min(hn::Max(hn::Add(below, rise), below), above);
}

/// Where the first row around each sample begins in a table, and the place between the rows: from
/// the first of two towards the second, or from the second of four towards the third.
struct Rows {
  Lanes<std::int32_t> begin;
  Lanes<float> fraction;
};

/// Where the four values of each sample begin in the first of its rows, and the fraction of its
/// cell.
struct Places {
  Lanes<std::int32_t> begin;
  Lanes<float> fraction;
};

/// vndf::weighted_rows, without the weights.
HWY_INLINE void place_rows(const QuantileTable& table, V coordinate, Rows& rows, std::size_t i) {
  const std::size_t cells = table.rows() - 1;
  const bool is_linear = table.blend() == RowBlend::linear;
  const CellVector r =
      cell_within(inside(coordinate), cells, is_linear ? 0 : 1, is_linear ? cells - 1 : cells - 2);
  const auto first = is_linear ? r.index : hn::Sub(r.index, hn::Set(di, 1));
  const auto stride = hn::Set(di, static_cast<std::int32_t>(2 * table.columns()));
  hn::Store(hn::Mul(first, stride), di, rows.begin.data() + i);
  store(r.fraction, rows.fraction, i);
}

/// The column of each sample in rows that begin at `begin`.
HWY_INLINE void place_column(const QuantileTable& table, V coordinate, hn::Vec<Ints> begin,
                             Places& places, std::size_t i) {
  const CellVector c = cell_within(coordinate, table.columns() - 1);
  const auto in_row = hn::ShiftLeft<1>(c.index);  // a node is two numbers
  hn::Store(hn::Add(in_row, begin), di, places.begin.data() + i);
  store(c.fraction, places.fraction, i);
}

/// Four numbers of each sample.
struct FourVectors {
  V v0, v1, v2, v3;
};

#if HWY_TARGET == HWY_SCALAR

/// The numbers at p[begin] to p[begin + 3], `p` in turn the first of each row, weighted.
template <std::size_t kRows>
FourVectors weighted_fours(const float* p, std::size_t stride, const std::int32_t* begin,
                           const V* weights) {
  FourVectors sum{hn::Zero(d), hn::Zero(d), hn::Zero(d), hn::Zero(d)};
  for (std::size_t r = 0; r < kRows; ++r) {
    const float* four = p + *begin + r * stride;
    const V w = kRows > 1 ? weights[r] : set(1.0f);
    sum = {hn::MulAdd(w, set(four[0]), sum.v0), hn::MulAdd(w, set(four[1]), sum.v1),
           hn::MulAdd(w, set(four[2]), sum.v2), hn::MulAdd(w, set(four[3]), sum.v3)};
  }
  return sum;
}

#else

/// Four numbers from each of p + begin[0], p + begin[4], ...: one for each block of four lanes.
template <class D>
HWY_INLINE hn::Vec<D> load_fours(D tag, const float* p, const std::int32_t* begin) {
  if constexpr (hn::MaxLanes(D()) == 4) {
    return hn::LoadU(tag, p + *begin);
  } else {
    const hn::Half<D> half;
    return hn::Combine(tag, load_fours(half, p, begin + hn::MaxLanes(D()) / 2),
                       load_fours(half, p, begin));
  }
}

/// load_fours() of samples k, k + 4, ..., blended over rows that lie `stride` apart.
template <std::size_t kRows, int k>
HWY_INLINE V blended_fours(const float* p, std::size_t stride, const std::int32_t* begin,
                           const V* weights) {
  V sum = load_fours(d, p, begin + k);
  if constexpr (kRows > 1) sum = hn::Mul(sum, hn::Broadcast<k>(weights[0]));
  for (std::size_t r = 1; r < kRows; ++r)
    sum = hn::MulAdd(hn::Broadcast<k>(weights[r]), load_fours(d, p + r * stride, begin + k), sum);
  return sum;
}

/// Of each sample the four numbers from p + begin on, blended over rows that lie `stride` apart.
template <std::size_t kRows>
HWY_INLINE FourVectors weighted_fours(const float* p, std::size_t stride, const std::int32_t* begin,
                                      const V* weights) {
  const V a = blended_fours<kRows, 0>(p, stride, begin, weights);
  const V b = blended_fours<kRows, 1>(p, stride, begin, weights);
  const V c = blended_fours<kRows, 2>(p, stride, begin, weights);
  const V e = blended_fours<kRows, 3>(p, stride, begin, weights);
  // The transposition of every block of four lanes.
  const hn::Repartition<std::uint64_t, Floats> pairs;
  const auto ab_low = hn::BitCast(pairs, hn::InterleaveLower(d, a, b));
  const auto ab_high = hn::BitCast(pairs, hn::InterleaveUpper(d, a, b));
  const auto ce_low = hn::BitCast(pairs, hn::InterleaveLower(d, c, e));
  const auto ce_high = hn::BitCast(pairs, hn::InterleaveUpper(d, c, e));
  return {hn::BitCast(d, hn::InterleaveLower(pairs, ab_low, ce_low)),
          hn::BitCast(d, hn::InterleaveUpper(pairs, ab_low, ce_low)),
          hn::BitCast(d, hn::InterleaveLower(pairs, ab_high, ce_high)),
          hn::BitCast(d, hn::InterleaveUpper(pairs, ab_high, ce_high))};
}

#endif

/// The values of the table, in [0, 1]; `row_fraction` as in Rows.
HWY_INLINE V value(const QuantileTable& table, V row_fraction, const Places& places,
                   std::size_t i) {
  const float* values = &table.row(0)->value;
  const std::size_t stride = 2 * table.columns();
  const std::int32_t* begin = places.begin.data() + i;
  const V fraction = load(places.fraction, i), one = set(1.0f);
  if (table.rows() == 1) {
    const auto [v0, t0, v1, t1] = weighted_fours<1>(values, 0, begin, nullptr);
    return clamped(hermite(v0, t0, v1, t1, fraction));
  }
  if (table.blend() == RowBlend::linear) {
    const V weights[]{hn::Sub(one, row_fraction), row_fraction};
    const auto [v0, t0, v1, t1] = weighted_fours<2>(values, stride, begin, weights);
    return clamped(hermite(v0, t0, v1, t1, fraction));
  }
  // vndf::lagrange_weights
  const V x1 = row_fraction, x = hn::Add(x1, one), x2 = hn::Sub(x1, one),
          x3 = hn::Sub(x1, set(2.0f));
  const V low = hn::Mul(x, x1), high = hn::Mul(x2, x3);
  const V weights[]{hn::Mul(hn::Mul(x1, high), set(-1.0f / 6)),
                    hn::Mul(hn::Mul(x, high), set(0.5f)), hn::Mul(hn::Mul(low, x3), set(-0.5f)),
                    hn::Mul(hn::Mul(low, x2), set(1.0f / 6))};
  auto [v0, t0, v1, t1] = weighted_fours<4>(values, stride, begin, weights);
  // vndf::with_limited_tangents
  const V most = hn::Mul(set(static_cast<float>(kSteepest)), hn::Sub(v1, v0));
  t0 = hn::Max(hn::Min(t0, most), hn::Zero(d));
  t1 = hn::Max(hn::Min(t1, most), hn::Zero(d));
  return clamped(hermite(v0, t0, v1, t1, fraction));
}

}  // namespace
}  // namespace vndf::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // guard of the target
