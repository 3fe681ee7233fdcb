// The vectors of a batch: one number of each of 4, 8 or 16 samples, as many as the target has
// lanes, and the few things that every step does with them.

// Included once for each target: the guard turns over with every one.
#if defined(VNDF_BATCH_VECTORS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef VNDF_BATCH_VECTORS_INL_H
#undef VNDF_BATCH_VECTORS_INL_H
#else
#define VNDF_BATCH_VECTORS_INL_H
#endif

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include "vndf/batch/blocks.h"
#include "vndf/kernel.h"

HWY_BEFORE_NAMESPACE();
namespace vndf::batch::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, kMaxLanes>;
using Words = hn::RebindToUnsigned<Floats>;
using V = hn::Vec<Floats>;
using W = hn::Vec<Words>;
constexpr Floats d;
constexpr Words dw;

HWY_INLINE V set(float x) {
  return hn::Set(d, x);
}
HWY_INLINE W set(std::uint32_t x) {
  return hn::Set(dw, x);
}
HWY_INLINE V load(const Lanes<float>& from, std::size_t i) {
  return hn::Load(d, from.data() + i);
}
HWY_INLINE W load(const Lanes<std::uint32_t>& from, std::size_t i) {
  return hn::Load(dw, from.data() + i);
}
HWY_INLINE void store(V v, Lanes<float>& to, std::size_t i) {
  hn::Store(v, d, to.data() + i);
}
HWY_INLINE void store(W v, Lanes<std::uint32_t>& to, std::size_t i) {
  hn::Store(v, dw, to.data() + i);
}
HWY_INLINE W bits_of(V a) {
  return hn::BitCast(dw, a);
}
HWY_INLINE V floats_of(W a) {
  return hn::BitCast(d, a);
}

/// All bits of the lanes whose sign bit is set.
HWY_INLINE W sign_mask(V a) {
  return hn::BitCast(dw, hn::BroadcastSignBit(hn::BitCast(hn::RebindToSigned<Words>(), a)));
}

/// a b + c in two roundings, as the scalar kernel has it.
HWY_INLINE V multiply_add(V a, V b, V c) {
  return hn::Add(hn::Mul(a, b), c);
}

/// Asks for the cache line two blocks beyond `p`, also of an output. A batch walks ten arrays, more
/// than the prefetchers of processors follow well; what is beyond the end of one does no harm.
HWY_INLINE void prefetch_ahead(const float* p) {
  const auto address = reinterpret_cast<std::uintptr_t>(p) + 2 * kBlock * sizeof(float);
  hwy::Prefetch(reinterpret_cast<const float*>(address));
}

/// kernel::vndf_within.
HWY_INLINE hn::Mask<Floats> within(V a, float low, float high) {
  const W above = hn::Sub(bits_of(a), set(kernel::bits_of(low)));
  return hn::RebindMask(d, hn::Lt(above, set(kernel::bits_of(high) - kernel::bits_of(low))));
}

/// Samples of the block that begins at `begin` of `size`, in whole vectors.
HWY_INLINE std::size_t block_size(std::size_t begin, std::size_t size) {
  const std::size_t lanes = hn::Lanes(d);
  return std::min(kBlock, (size - begin + lanes - 1) / lanes * lanes);
}

}  // namespace
}  // namespace vndf::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // guard of the target
