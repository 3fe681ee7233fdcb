// sample_batch(): the walk over the blocks of a batch, compiled once for each target, and the
// dispatch to the target of this processor.
#include "vndf/batch/sample_batch.h"

#include <cstddef>
#include <stdexcept>
#include <string>

#include "vndf/batch/batch_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "vndf/batch/sample_batch.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "vndf/batch/directions-inl.h"
#include "vndf/batch/normals-inl.h"

HWY_BEFORE_NAMESPACE();
namespace vndf::batch::HWY_NAMESPACE {
namespace {

void sample_directions(const kernel::VndfTables& tables, DirectionInputs& inputs,
                       Samples& samples) {
  Sampling sampling(tables, samples);
  Directions directions;
  FlattenedBlock flattened;
  for (std::size_t begin = 0; begin < samples.size; begin += kBlock) {
    DirectionBlock block{inputs.x.block(begin), inputs.y.block(begin), inputs.z.block(begin),
                         inputs.alpha_x.block(begin), inputs.alpha_y.block(begin)};
    if (!samples.surface.is_flat()) block = flatten(samples.surface, block, flattened);
    stretch(tables, block, block_size(begin, samples.size), directions);
    sampling.block(begin, directions);
  }
}

void sample_direction(const kernel::VndfTables& tables, const kernel::VndfDirection& direction,
                      Samples& samples) {
  Sampling sampling(tables, samples);
  Directions directions;
  for (std::size_t i = 0; i < kBlock; ++i) directions.set(i, direction);
  for (std::size_t begin = 0; begin < samples.size; begin += kBlock)
    sampling.block(begin, directions);
}

}  // namespace
}  // namespace vndf::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vndf {
namespace batch {

void stretch_each(const kernel::VndfTables& tables, const DirectionBlock& inputs, std::size_t begin,
                  std::size_t end, Directions& directions) {
  for (std::size_t i = begin; i < end; ++i)
    directions.set(i, kernel::vndf_at(tables, {inputs.x[i], inputs.y[i], inputs.z[i]},
                                      inputs.alpha_x[i], inputs.alpha_y[i]));
}

void sample_each_below(const kernel::VndfTables& tables, const Directions& directions,
                       const RoughSurface<float>& surface, std::size_t n, const float* u1,
                       const float* u2, float* x, float* y, float* z) {
  for (std::size_t i = 0; i < n; ++i) {
    if ((directions.below >> i & 1) == 0) continue;
    const Vec3<float> m = kernel::vndf_drawn(tables, directions.lower[i], u1[i], u2[i]);
    const Vec3<float> wm =
        kernel::vndf_unit_or_up(surface.is_flat() ? m : surface.tilted_normal(m));
    x[i] = wm.x;
    y[i] = wm.y;
    z[i] = wm.z;
  }
}

namespace {

HWY_EXPORT(sample_directions);
HWY_EXPORT(sample_direction);

/// Throws std::invalid_argument unless the span `name` has `expected` values.
void check_size(const char* name, std::size_t size, std::size_t expected) {
  if (size == expected) return;
  throw std::invalid_argument(std::string("sample_batch: the span ") + name + " has " +
                              std::to_string(size) + " values where wm.x has " +
                              std::to_string(expected) + "; give all spans one size");
}

Samples samples_of(std::span<const float> u1, std::span<const float> u2, const NormalSpans& wm) {
  const std::size_t n = wm.x.size();
  check_size("wm.y", wm.y.size(), n);
  check_size("wm.z", wm.z.size(), n);
  check_size("u1", u1.size(), n);
  check_size("u2", u2.size(), n);
  return {n, Input(u1), Input(u2), Output(wm.x), Output(wm.y), Output(wm.z)};
}

void check_size(const DirectionSpans& wi, std::size_t n) {
  check_size("wi.x", wi.x.size(), n);
  check_size("wi.y", wi.y.size(), n);
  check_size("wi.z", wi.z.size(), n);
}

}  // namespace
}  // namespace batch

void sample_batch(const Kernel& kernel, const DirectionSpans& wi, const AlphaSpans& alpha,
                  std::span<const float> u1, std::span<const float> u2, const NormalSpans& wm) {
  using namespace batch;
  Samples samples = samples_of(u1, u2, wm);
  check_size(wi, samples.size);
  check_size("alpha.x", alpha.x.size(), samples.size);
  check_size("alpha.y", alpha.y.size(), samples.size);
  DirectionInputs inputs{Input(wi.x), Input(wi.y), Input(wi.z), Input(alpha.x), Input(alpha.y)};
  HWY_DYNAMIC_DISPATCH(sample_directions)(kernel.tables(), inputs, samples);
}

void sample_batch(const Kernel& kernel, const DirectionSpans& wi,
                  const RoughSurface<float>& surface, std::span<const float> u1,
                  std::span<const float> u2, const NormalSpans& wm) {
  using namespace batch;
  Samples samples = samples_of(u1, u2, wm);
  check_size(wi, samples.size);
  samples.surface = surface;
  const Alpha<float>& alpha = surface.alpha();
  DirectionInputs inputs{Input(wi.x), Input(wi.y), Input(wi.z), Input(alpha.x), Input(alpha.y)};
  HWY_DYNAMIC_DISPATCH(sample_directions)(kernel.tables(), inputs, samples);
}

void sample_batch(const KernelDirection& direction, std::span<const float> u1,
                  std::span<const float> u2, const NormalSpans& wm) {
  using namespace batch;
  Samples samples = samples_of(u1, u2, wm);
  const auto [tables, stretched, surface] = direction.view();
  samples.surface = surface;
  HWY_DYNAMIC_DISPATCH(sample_direction)(tables, stretched, samples);
}

}  // namespace vndf
#endif  // HWY_ONCE
