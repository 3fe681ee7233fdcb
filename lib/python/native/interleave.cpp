// Columns of interleaved numbers, compiled once for each target.
#include "interleave.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "python/native/interleave.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace vndf::python::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

void split_pairs(const float* numbers, std::size_t count, float* x, float* y) {
  const hn::ScalableTag<float> tag;
  std::size_t i = 0;
  for (; i + hn::Lanes(tag) <= count; i += hn::Lanes(tag)) {
    hn::Vec<decltype(tag)> a, b;
    hn::LoadInterleaved2(tag, numbers + 2 * i, a, b);
    hn::StoreU(a, tag, x + i);
    hn::StoreU(b, tag, y + i);
  }
  for (; i < count; ++i) {
    x[i] = numbers[2 * i];
    y[i] = numbers[2 * i + 1];
  }
}

void split_triples(const float* numbers, std::size_t count, float* x, float* y, float* z) {
  const hn::ScalableTag<float> tag;
  std::size_t i = 0;
  for (; i + hn::Lanes(tag) <= count; i += hn::Lanes(tag)) {
    hn::Vec<decltype(tag)> a, b, c;
    hn::LoadInterleaved3(tag, numbers + 3 * i, a, b, c);
    hn::StoreU(a, tag, x + i);
    hn::StoreU(b, tag, y + i);
    hn::StoreU(c, tag, z + i);
  }
  for (; i < count; ++i) {
    x[i] = numbers[3 * i];
    y[i] = numbers[3 * i + 1];
    z[i] = numbers[3 * i + 2];
  }
}

void join_triples(const float* x, const float* y, const float* z, std::size_t count,
                  float* numbers) {
  const hn::ScalableTag<float> tag;
  std::size_t i = 0;
  for (; i + hn::Lanes(tag) <= count; i += hn::Lanes(tag))
    hn::StoreInterleaved3(hn::LoadU(tag, x + i), hn::LoadU(tag, y + i), hn::LoadU(tag, z + i), tag,
                          numbers + 3 * i);
  for (; i < count; ++i) {
    numbers[3 * i] = x[i];
    numbers[3 * i + 1] = y[i];
    numbers[3 * i + 2] = z[i];
  }
}

}  // namespace
}  // namespace vndf::python::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vndf::python {
namespace {

HWY_EXPORT(split_pairs);
HWY_EXPORT(split_triples);
HWY_EXPORT(join_triples);

}  // namespace

void split_pairs(const float* numbers, std::size_t count, float* x, float* y) {
  HWY_DYNAMIC_DISPATCH(split_pairs)(numbers, count, x, y);
}

void split_triples(const float* numbers, std::size_t count, float* x, float* y, float* z) {
  HWY_DYNAMIC_DISPATCH(split_triples)(numbers, count, x, y, z);
}

void join_triples(const float* x, const float* y, const float* z, std::size_t count,
                  float* numbers) {
  HWY_DYNAMIC_DISPATCH(join_triples)(x, y, z, count, numbers);
}

}  // namespace vndf::python
#endif  // HWY_ONCE
