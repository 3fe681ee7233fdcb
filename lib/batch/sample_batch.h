// Many visible normals at once, eight or sixteen side by side: Algorithm 4 of Heitz and d'Eon 2014
// on structures of arrays, with the widest vectors of the processor, chosen when the program runs
// (Google Highway). Every sample is that of TabulatedSampler<float>::sample(), but for rounding.
#pragma once

#include <cstddef>
#include <span>

#include "vndf/incident_sampler.h"
#include "vndf/tabulated_sampler.h"
#include "vndf/vec.h"

namespace vndf {

/// Unit vectors, one component a span; all of one size.
struct DirectionSpans {
  std::span<const float> x, y, z;
};
struct AlphaSpans {
  std::span<const float> x, y;
};
struct NormalSpans {
  std::span<float> x, y, z;
};

/// A normal of a batch is that of TabulatedSampler<float>::sample(), but for what a change of u1
/// and u2 by kBatchUError makes and for kBatchAngle, in radians between the normals at unit
/// roughness and unit mean slope; inputs outside their range give the same (0, 0, 1). Targets
/// differ among themselves by as much, for some of them fuse multiplications and additions. One in
/// 4000 of inputs chosen to be hard exceeds it, up to sevenfold, at the rim of bounded slopes, and
/// fewer by up to 1.8 times elsewhere.
inline constexpr double kBatchUError = 3e-7, kBatchAngle = 1e-6;

/// Draws wm[i] for wi[k], alpha[k], u1[i], u2[i], k = i / per_direction: of each direction
/// `per_direction` samples side by side, whose setup is done once. Any length; spans need no
/// alignment, and `wm` may not overlap the others. Throws std::invalid_argument, naming them, where
/// u1, u2 and wm differ in size or are not `per_direction` times as long as wi and alpha.
void sample_batch(const TabulatedSampler<float>& sampler, const DirectionSpans& wi,
                  const AlphaSpans& alpha, std::span<const float> u1, std::span<const float> u2,
                  const NormalSpans& wm, std::size_t per_direction = 1);

/// The same with one roughness for all.
void sample_batch(const TabulatedSampler<float>& sampler, const DirectionSpans& wi,
                  const Alpha<float>& alpha, std::span<const float> u1, std::span<const float> u2,
                  const NormalSpans& wm, std::size_t per_direction = 1);

/// The same with one incident direction and roughness for all, whose setup is already done.
void sample_batch(const IncidentSampler<float>& incident, std::span<const float> u1,
                  std::span<const float> u2, const NormalSpans& wm);

}  // namespace vndf
