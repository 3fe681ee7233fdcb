// Looking up baked tables (vndf/kernel_text.h): the cell of each sample on an axis, the blend of
// its patch, and cubics.
//
// Guides are gathered. Patches are not: of each sample the four cubics are loaded as they lie. Four
// lanes of a vector hold one sample then, the cubics are blended so, and a transposition puts the
// samples side by side. That takes 4 loads a sample where gathers take 16.

// Included once for each target: the guard turns over with every one.
#if defined(VNDF_BATCH_CELLS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef VNDF_BATCH_CELLS_INL_H
#undef VNDF_BATCH_CELLS_INL_H
#else
#define VNDF_BATCH_CELLS_INL_H
#endif

#include <cstddef>
#include <cstdint>

#include <hwy/highway.h>

#include "vndf/batch/blocks.h"
#include "vndf/batch/vectors-inl.h"
#include "vndf/kernel.h"

HWY_BEFORE_NAMESPACE();
namespace vndf::batch::HWY_NAMESPACE {
namespace {

/// Where in its cell each sample is, and the distance that the guide gives.
struct CellVector {
  V f;
  W offset;
};

/// Entries of guides.
struct GuideVector {
  V start;
  W offset;
};

#if HWY_TARGET == HWY_SCALAR

HWY_INLINE GuideVector fetch_guides(kernel::Block block, W entry) {
  const kernel::Guide guide = kernel::fetch_guide(block, hn::GetLane(entry));
  return {set(guide.start), set(guide.offset)};
}

#else

/// The entries at distances `entry`, each of them gathered as one number of 64 bits.
HWY_INLINE GuideVector fetch_guides(kernel::Block block, W entry) {
  const hn::Repartition<std::uint64_t, Floats> pairs;
  const auto gathered = [&](auto half) HWY_ATTR {
    const auto at = hn::BitCast(hn::RebindToSigned<decltype(pairs)>(), hn::PromoteTo(pairs, half));
    const auto* first = reinterpret_cast<const std::uint64_t*>(block.bytes);
    return hn::BitCast(dw, hn::GatherOffset(pairs, first, at));
  };
  const W low = gathered(hn::LowerHalf(entry));
  const W high = gathered(hn::UpperHalf(hn::Half<Words>(), entry));
  return {floats_of(hn::ConcatEven(dw, high, low)), hn::ConcatOdd(dw, high, low)};
}

#endif

/// kernel::vndf_cell.
HWY_INLINE CellVector cell_of(kernel::Block block, std::uint32_t guide, std::uint32_t shift,
                              V place) {
  const W key = hn::ShiftRightSame(bits_of(place), static_cast<int>(shift));
  const GuideVector entry = fetch_guides(block, hn::Add(hn::ShiftLeft<3>(key), set(guide)));
  return {hn::Sub(place, entry.start), entry.offset};
}

/// Cells as arrays: `offset` is the distance of the coefficients from the first byte of the block.
struct Cells {
  Lanes<float> f;
  Lanes<std::uint32_t> offset;
};

HWY_INLINE void store(CellVector v, Cells& to, std::size_t i) {
  store(v.f, to.f, i);
  store(v.offset, to.offset, i);
}

/// The coefficients of a cubic for each sample.
struct CubicVector {
  V c0, c1, c2, c3;

  /// kernel::vndf_values.
  HWY_INLINE V at(V f) const {
    const V low = multiply_add(f, c1, c0), high = multiply_add(f, c3, c2);
    return multiply_add(hn::Mul(f, f), high, low);
  }
};

/// Four numbers of each sample.
struct FourVectors {
  V v0, v1, v2, v3;
};

#if HWY_TARGET == HWY_SCALAR

HWY_INLINE FourVectors fetch_fours(kernel::Block block, const std::uint32_t* offsets) {
  const auto* c = reinterpret_cast<const float*>(block.bytes + *offsets);
  return {set(c[0]), set(c[1]), set(c[2]), set(c[3])};
}

HWY_INLINE FourVectors blended_fours(kernel::Block block, const std::uint32_t* offsets, V g) {
  const auto* c = reinterpret_cast<const float*>(block.bytes + *offsets);
  const auto blended = [&](int k) {
    return CubicVector{set(c[k]), set(c[4 + k]), set(c[8 + k]), set(c[12 + k])}.at(g);
  };
  return {blended(0), blended(1), blended(2), blended(3)};
}

#else

/// The four numbers at each of offsets[0], offsets[4], ...: one for each block of four lanes. They
/// are loaded into all blocks and kept in their own and those above, for which processors need no
/// exchange of blocks.
HWY_INLINE V load_fours(const unsigned char* bytes, const std::uint32_t* offsets) {
  const auto loaded = [=](std::size_t lane) HWY_ATTR {
    return hn::LoadDup128(d, reinterpret_cast<const float*>(bytes + offsets[lane]));
  };
  V fours = loaded(0);
  for (std::size_t lane = 4; lane < hn::MaxLanes(d); lane += 4) {
    const auto above = hn::Ge(hn::Iota(d, 0.0f), set(static_cast<float>(lane)));
    fours = hn::IfThenElse(above, loaded(lane), fours);
  }
  return fours;
}

// The patches at offsets[0], offsets[4], ...: cubics in g whose coefficients are the four numbers
// of a cubic in u.

#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX3

/// Two coefficients are loaded at once: that takes half the loads, and Highway has no name for the
/// exchange of blocks that parts them.
HWY_INLINE CubicVector load_patches(const unsigned char* bytes, const std::uint32_t* offsets) {
  const auto loaded = [=](std::size_t cubic, std::size_t lane) HWY_ATTR {
    const hn::Half<Floats> half;
    const auto at = [=](std::size_t k) HWY_ATTR {
      return hn::LoadU(half, reinterpret_cast<const float*>(bytes + offsets[k]) + 4 * cubic);
    };
    return hn::Combine(d, at(lane + 4), at(lane));
  };
  const auto even = [](V a, V b) HWY_ATTR { return V{_mm512_shuffle_f32x4(a.raw, b.raw, 0x88)}; };
  const auto odd = [](V a, V b) HWY_ATTR { return V{_mm512_shuffle_f32x4(a.raw, b.raw, 0xdd)}; };
  const V a = loaded(0, 0), b = loaded(0, 8), c = loaded(2, 0), e = loaded(2, 8);
  return {even(a, b), odd(a, b), even(c, e), odd(c, e)};
}

#else

HWY_INLINE CubicVector load_patches(const unsigned char* bytes, const std::uint32_t* offsets) {
  return {load_fours(bytes, offsets), load_fours(bytes + 16, offsets),
          load_fours(bytes + 32, offsets), load_fours(bytes + 48, offsets)};
}

#endif

/// kernel::vndf_blend of samples k, k + 4, ...
template <int k>
HWY_INLINE V blended_every_fourth(kernel::Block block, const std::uint32_t* offsets, V places) {
  return load_patches(block.bytes, offsets + k).at(hn::Broadcast<k>(places));
}

/// The transposition of every block of four lanes.
HWY_INLINE FourVectors transposed(V a, V b, V c, V e) {
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

/// The four numbers at each of `offsets`.
HWY_INLINE FourVectors fetch_fours(kernel::Block block, const std::uint32_t* offsets) {
  return transposed(load_fours(block.bytes, offsets), load_fours(block.bytes, offsets + 1),
                    load_fours(block.bytes, offsets + 2), load_fours(block.bytes, offsets + 3));
}

/// The cubics of patches as they lie in memory.
HWY_INLINE FourVectors blended_fours(kernel::Block block, const std::uint32_t* offsets, V g) {
  return transposed(
      blended_every_fourth<0>(block, offsets, g), blended_every_fourth<1>(block, offsets, g),
      blended_every_fourth<2>(block, offsets, g), blended_every_fourth<3>(block, offsets, g));
}

#endif

/// The coefficients in the order of the numbers in memory.
HWY_INLINE CubicVector cubic_of(const FourVectors& fours) {
  return {fours.v0, fours.v2, fours.v1, fours.v3};
}

/// The cubics at `offsets`.
HWY_INLINE CubicVector cubics(kernel::Block block, const std::uint32_t* offsets) {
  return cubic_of(fetch_fours(block, offsets));
}

/// The cubics of the patches at `offsets`, at the places `g` in their rows.
HWY_INLINE CubicVector blended_cubics(kernel::Block block, const std::uint32_t* offsets, V g) {
  return cubic_of(blended_fours(block, offsets, g));
}

}  // namespace
}  // namespace vndf::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // guard of the target
