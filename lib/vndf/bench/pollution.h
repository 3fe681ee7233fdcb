// What a renderer does between two samples, as far as caches feel it: traversal, shading and
// textures push the tables of a sampler out of the nearest cache.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "vndf/vec.h"

namespace vndf::bench {

/// A normal times this changes nothing to which it is added, but must be known before.
inline constexpr float kTiny = 1e-20f;

class Pollution {
 public:
  static constexpr std::size_t kBytes = std::size_t{8} << 20, kLine = 64;
  static constexpr int kLinesPerSample = 24;

  Pollution() : buffer_(kBytes / sizeof(float)) {}

  /// Reads random cache lines and returns 0. It begins when `last`, of the normal before and below
  /// 1e10, is known and the lines before are there; and a sample to whose wi the result is added
  /// begins when it has ended. Otherwise the processor would hide one behind the other.
  float read(float last) noexcept {
    state_ += static_cast<std::uint32_t>(static_cast<int>(last * kTiny));
    float sum = 0;
    for (int line = 0; line < kLinesPerSample; ++line) {
      state_ = state_ * 1664525u + 1013904223u;
      sum += buffer_[state_ / kStatesPerLine * (kLine / sizeof(float))];
    }
    state_ += static_cast<std::uint32_t>(static_cast<int>(sum));
    return sum;
  }

 private:
  /// The high bits of the generator, which are its random ones, choose the line.
  static constexpr std::uint32_t kStatesPerLine =
      static_cast<std::uint32_t>((std::uint64_t{1} << 32) / (kBytes / kLine));

  std::vector<float> buffer_;
  std::uint32_t state_ = 1;
};

/// Computes as little as its result needs: what is timed around it is not of any sampler.
struct EmptySampler {
  template <class T>
  Vec3<T> sample(const Vec3<T>& wi, const Alpha<T>& alpha, T u1, T u2) const noexcept {
    return {wi.x + alpha.x, wi.y + alpha.y, wi.z + u1 + u2};
  }
};

}  // namespace vndf::bench
