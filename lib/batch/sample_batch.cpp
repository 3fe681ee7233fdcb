// sample_batch(): the walk over the blocks of a batch, compiled once for each target, and the
// dispatch to the target of this processor.
#include "batch/sample_batch.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>

#include "batch/batch_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "batch/sample_batch.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "batch/incidents-inl.h"
#include "batch/normals-inl.h"

HWY_BEFORE_NAMESPACE();
namespace vndf::batch::HWY_NAMESPACE {
namespace {

void sample_directions(const TabulatedSampler<float>& sampler, DirectionInputs& inputs,
                       Samples& samples) {
  Sampling sampling(sampler, samples);
  Incidents directions;
  for (std::size_t begin = 0; begin < samples.size; begin += kBlock) {
    stretch(sampler, inputs, begin, directions);
    sampling.block(begin, directions);
  }
}

/// The same with several samples for each direction: a block of directions serves several blocks of
/// samples, in which each direction is repeated.
void sample_repeated_directions(const TabulatedSampler<float>& sampler, DirectionInputs& inputs,
                                Samples& samples) {
  Sampling sampling(sampler, samples);
  Incidents directions, repeated;
  const std::size_t each = inputs.per_direction;
  for (std::size_t begin = 0, stretched = 0; begin < samples.size; begin += kBlock) {
    const std::size_t end = std::min(begin + kBlock, samples.size);
    for (std::size_t i = begin; i < end;) {
      const std::size_t direction = i / each, next = std::min((direction + 1) * each, end);
      if (direction == stretched) {
        stretch(sampler, inputs, direction, directions);
        stretched += kBlock;
      }
      repeat(directions, direction % kBlock, repeated, i - begin, next - begin,
             sampler.tables().tail_order);
      i = next;
    }
    sampling.block(begin, repeated);
  }
}

void sample_incident(const IncidentSampler<float>& incident, Samples& samples) {
  const TabulatedSampler<float>& sampler = incident.sampler();
  const Incidents all = all_of(incident.incident(), 2 * sampler.tables().marginal.columns());
  Sampling sampling(sampler, samples);
  for (std::size_t begin = 0; begin < samples.size; begin += kBlock) sampling.block(begin, all);
}

}  // namespace
}  // namespace vndf::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vndf {
namespace batch {
namespace {

HWY_EXPORT(sample_directions);
HWY_EXPORT(sample_repeated_directions);
HWY_EXPORT(sample_incident);

/// Throws std::invalid_argument unless the span `name` has `expected` values.
void check_size(const char* name, std::size_t size, std::size_t expected) {
  if (size == expected) return;
  throw std::invalid_argument(std::string("sample_batch: the span ") + name + " has " +
                              std::to_string(size) + " values where wm.x asks for " +
                              std::to_string(expected) +
                              "; give u1, u2 and wm one size, that of wi and alpha times the "
                              "samples per direction");
}

Samples samples_of(std::span<const float> u1, std::span<const float> u2, const NormalSpans& wm) {
  const std::size_t n = wm.x.size();
  check_size("wm.y", wm.y.size(), n);
  check_size("wm.z", wm.z.size(), n);
  check_size("u1", u1.size(), n);
  check_size("u2", u2.size(), n);
  return {n, Input(u1), Input(u2), Output(wm.x), Output(wm.y), Output(wm.z)};
}

/// Directions that `samples` normals need.
std::size_t directions_of(const DirectionSpans& wi, std::size_t samples,
                          std::size_t per_direction) {
  if (per_direction == 0 || samples % per_direction != 0)
    throw std::invalid_argument("sample_batch: wm.x has " + std::to_string(samples) +
                                " values, not a multiple of the " + std::to_string(per_direction) +
                                " samples per direction; give each direction as many, 1 or more");
  const std::size_t n = samples / per_direction;
  check_size("wi.x", wi.x.size(), n);
  check_size("wi.y", wi.y.size(), n);
  check_size("wi.z", wi.z.size(), n);
  return n;
}

void dispatch(const TabulatedSampler<float>& sampler, DirectionInputs& inputs, Samples& samples) {
  if (inputs.per_direction == 1)
    HWY_DYNAMIC_DISPATCH(sample_directions)(sampler, inputs, samples);
  else
    HWY_DYNAMIC_DISPATCH(sample_repeated_directions)(sampler, inputs, samples);
}

}  // namespace
}  // namespace batch

void sample_batch(const TabulatedSampler<float>& sampler, const DirectionSpans& wi,
                  const AlphaSpans& alpha, std::span<const float> u1, std::span<const float> u2,
                  const NormalSpans& wm, std::size_t per_direction) {
  using namespace batch;
  Samples samples = samples_of(u1, u2, wm);
  const std::size_t n = directions_of(wi, samples.size, per_direction);
  check_size("alpha.x", alpha.x.size(), n);
  check_size("alpha.y", alpha.y.size(), n);
  DirectionInputs inputs{n,           per_direction,  Input(wi.x),   Input(wi.y),
                         Input(wi.z), Input(alpha.x), Input(alpha.y)};
  dispatch(sampler, inputs, samples);
}

void sample_batch(const TabulatedSampler<float>& sampler, const DirectionSpans& wi,
                  const Alpha<float>& alpha, std::span<const float> u1, std::span<const float> u2,
                  const NormalSpans& wm, std::size_t per_direction) {
  using namespace batch;
  Samples samples = samples_of(u1, u2, wm);
  const std::size_t n = directions_of(wi, samples.size, per_direction);
  DirectionInputs inputs{n,           per_direction,  Input(wi.x),   Input(wi.y),
                         Input(wi.z), Input(alpha.x), Input(alpha.y)};
  dispatch(sampler, inputs, samples);
}

void sample_batch(const IncidentSampler<float>& incident, std::span<const float> u1,
                  std::span<const float> u2, const NormalSpans& wm) {
  using namespace batch;
  Samples samples = samples_of(u1, u2, wm);
  HWY_DYNAMIC_DISPATCH(sample_incident)(incident, samples);
}

}  // namespace vndf
#endif  // HWY_ONCE
