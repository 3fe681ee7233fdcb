// The vectors of a batch: one number of each of 4, 8 or 16 samples, as many as the target has
// lanes, and the few things that every step does with them.

// Included once for each target: the guard turns over with every one.
#if defined(VNDF_BATCH_VECTORS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef VNDF_BATCH_VECTORS_INL_H
#undef VNDF_BATCH_VECTORS_INL_H
#else
#define VNDF_BATCH_VECTORS_INL_H
#endif

#include <cstddef>
#include <limits>

#include <hwy/highway.h>

#include "batch/blocks.h"

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

HWY_INLINE V set(float x) {
  return hn::Set(d, x);
}
HWY_INLINE V set(std::size_t n) {
  return hn::Set(d, static_cast<float>(n));
}
HWY_INLINE V load(const Lanes<float>& from, std::size_t i) {
  return hn::Load(d, from.data() + i);
}
HWY_INLINE void store(V v, Lanes<float>& to, std::size_t i) {
  hn::Store(v, d, to.data() + i);
}
HWY_INLINE V clamped(V x) {
  return hn::Min(hn::Max(x, hn::Zero(d)), set(1.0f));
}

/// The nearest number in [0, 1]; 0 where there is none.
HWY_INLINE V inside(V x) {
  return hn::IfThenElseZero(hn::Gt(x, hn::Zero(d)), hn::Min(x, set(1.0f)));
}

/// 1 / root of x >= 0, finite, to 2 roundings; an x below the smallest normal number counts as
/// that. The processors of x86 begin with 11 bits, or with 14 where vectors have 16 lanes, which a
/// step of Halley's or of Newton's makes full.
HWY_INLINE V inverse_root(V x) {
  x = hn::Max(x, set(std::numeric_limits<float>::min()));
#if HWY_ARCH_X86 && HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128
  // With y = (1 - h)^(1/2) / root(x): 1 / root(x) = y (1 + h / 2 + 3 h^2 / 8 + ...).
  const V y = hn::ApproximateReciprocalSqrt(x);
  const V h = hn::NegMulAdd(hn::Mul(x, y), y, set(1.0f));
  const V series = kMaxLanes == hn::Lanes(d) ? set(0.5f) : hn::MulAdd(h, set(0.375f), set(0.5f));
  return hn::MulAdd(hn::Mul(y, h), series, y);
#else
  return hn::Div(set(1.0f), hn::Sqrt(x));
#endif
}

}  // namespace
}  // namespace vndf::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // guard of the target
