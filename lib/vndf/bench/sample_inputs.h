// What samplers are timed on: incident directions, roughness and random numbers as structures of
// arrays, larger than the caches, walked block by block.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "vndf/vec.h"

namespace vndf::bench {

/// Some of the samples, all spans of one length: what a sampler reads and where its normals go.
struct SampleBlock {
  std::span<const float> wi_x, wi_y, wi_z, alpha_x, alpha_y, u1, u2;
  std::span<float> wm_x, wm_y, wm_z;

  std::size_t size() const { return u1.size(); }
};

/// The direction and the roughness of coherent samples: 55 degrees, off the axes.
inline constexpr Vec3<float> kCoherentWi{0.7f, 0.42f, 0.577581f};
inline constexpr Alpha<float> kCoherentAlpha{0.35f, 0.2f};

/// Bytes that one sample of incoherent input reads.
inline constexpr std::size_t kInputBytes = 7 * sizeof(float);

class SampleInputs {
 public:
  /// Length of the blocks that next() gives.
  static constexpr std::size_t kBlock = 4096;

  /// At least `samples` samples, a whole number of blocks: wi uniform over the hemisphere, alpha_x
  /// and alpha_y log-uniform in [0.05, 1], u1 and u2 whole multiples of 2^-24 in [0, 1).
  explicit SampleInputs(std::size_t samples, std::uint64_t seed = 1);

  std::size_t size() const { return values_[0].size(); }

  /// The next block, from the first again after the last: a sampler that is called again meets
  /// samples that it has not seen for long.
  SampleBlock next();

 private:
  static constexpr std::size_t kRead = 7, kWritten = 3;

  std::vector<float> values_[kRead], normals_[kWritten];
  std::size_t at_ = 0;
};

/// Samples whose input alone is twice the largest cache of this processor (64 MiB are assumed where
/// it does not tell).
std::size_t samples_beyond_caches();

}  // namespace vndf::bench
