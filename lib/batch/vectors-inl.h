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

/// u in [0, 1]; not a number becomes 0.
V inside(V u) {
  return hn::IfThenElseZero(hn::Gt(u, hn::Zero(d)), hn::Min(u, set(1.0f)));
}

}  // namespace
}  // namespace vndf::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // guard of the target
