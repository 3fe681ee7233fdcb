// The baseline of the benchmark: visible GGX normals by spherical caps, as published (Dupuy and
// Benyoub 2023), for structures of arrays.
#pragma once

#include <span>

#include "vndf/batch/spans.h"
#include "vndf/vec.h"

namespace vndf::bench {

/// Draws wm[i] for wi[i], alpha[i], u1[i] and u2[i]. All spans have the same size. As in the
/// published code, inputs out of range are not checked.
void caps_batch(const DirectionSpans& wi, const AlphaSpans& alpha, std::span<const float> u1,
                std::span<const float> u2, const NormalSpans& wm);

/// The same with one incident direction and roughness for all.
void caps_batch(const Vec3<float>& wi, const Alpha<float>& alpha, std::span<const float> u1,
                std::span<const float> u2, const NormalSpans& wm);

}  // namespace vndf::bench
