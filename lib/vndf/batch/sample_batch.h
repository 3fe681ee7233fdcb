// Many visible normals at once, eight or sixteen side by side: Algorithm 4 of Heitz and d'Eon 2014
// on structures of arrays, with the widest vectors of the processor, chosen when the program runs
// (Google Highway). Every sample is that of Kernel::sample(), to the last bit.
#pragma once

#include <span>

#include "vndf/batch/spans.h"
#include "vndf/kernel.h"
#include "vndf/vec.h"

namespace vndf {

/// Draws wm[i] for wi[i], alpha[i], u1[i], u2[i]. Any length; spans need no alignment, and `wm` may
/// not overlap the others. The normals are those of Kernel::sample() bit for bit, on every target
/// and for any input, where that is compiled without fused multiplications and additions (without
/// -mfma, -march=native and the like, or with -ffp-contract=off). Throws std::invalid_argument,
/// naming it, where a span differs in size from wm.x.
void sample_batch(const Kernel& kernel, const DirectionSpans& wi, const AlphaSpans& alpha,
                  std::span<const float> u1, std::span<const float> u2, const NormalSpans& wm);

/// The same with one surface for all, which is a roughness alone or one with correlated slopes or a
/// mean slope (rough_surface.h).
void sample_batch(const Kernel& kernel, const DirectionSpans& wi,
                  const RoughSurface<float>& surface, std::span<const float> u1,
                  std::span<const float> u2, const NormalSpans& wm);

/// The same with one incident direction and surface for all, whose setup is already done.
void sample_batch(const KernelDirection& direction, std::span<const float> u1,
                  std::span<const float> u2, const NormalSpans& wm);

}  // namespace vndf
