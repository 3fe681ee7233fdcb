// The inputs that samplers are timed on: incident directions, roughness and random numbers as
// structures of arrays. They are larger than the caches and used block by block, so that a sampler
// does not find its inputs in a cache.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "vndf/vec.h"

namespace vndf::bench {

/// A part of the samples: what a sampler reads, and where its normals go. All spans have one
/// length.
struct SampleBlock {
  std::span<const float> wi_x, wi_y, wi_z, alpha_x, alpha_y, u1, u2;
  std::span<float> wm_x, wm_y, wm_z;

  std::size_t size() const { return u1.size(); }
};

/// The direction and the roughness of coherent samples, at 55 degrees and off the axes so that no
/// shortcut applies.
inline constexpr Vec3<float> kCoherentWi{0.7f, 0.42f, 0.577581f};
inline constexpr Alpha<float> kCoherentAlpha{0.35f, 0.2f};

/// Bytes that one sample of incoherent input reads.
inline constexpr std::size_t kInputBytes = 7 * sizeof(float);

/// Random inputs, with room for the normals.
class SampleInputs {
 public:
  /// The number of samples in a block of next().
  static constexpr std::size_t kBlock = 4096;

  /// Makes at least `samples` samples, in whole blocks. wi is uniform over the hemisphere, alpha_x
  /// and alpha_y are log-uniform in [0.05, 1], and u1 and u2 are multiples of 2^-24 in [0, 1).
  explicit SampleInputs(std::size_t samples, std::uint64_t seed = 1);

  std::size_t size() const { return values_[0].size(); }

  /// The next block, which after the last is the first again.
  SampleBlock next();

 private:
  static constexpr std::size_t kRead = 7, kWritten = 3;

  std::vector<float> values_[kRead], normals_[kWritten];
  std::size_t at_ = 0;
};

/// The number of samples whose inputs fill twice the largest cache of this processor, or of one of
/// 64 MiB if the processor does not tell its size.
std::size_t samples_beyond_caches();

}  // namespace vndf::bench
