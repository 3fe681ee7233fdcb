// Imitates what a renderer does to the caches between two samples: traversal, shading and textures
// push the tables of a sampler out of the nearest cache.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "vndf/vec.h"

namespace vndf::bench {

/// A normal times this is too small to change a number that it is added to, but the processor has
/// to wait for the normal.
inline constexpr float kTiny = 1e-20f;

/// Reads memory that a sampler does not use.
class Pollution {
 public:
  static constexpr std::size_t kBytes = std::size_t{8} << 20, kLine = 64;
  static constexpr int kLinesPerSample = 24;

  Pollution() : buffer_(kBytes / sizeof(float)) {}

  /// Reads random cache lines and returns 0. The processor could hide this behind the samples
  /// around it, so each waits for the other: the reading starts when `last`, which comes from the
  /// previous normal and is below 1e10, is known, and a sample starts when the result is added to
  /// its wi.
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
  /// The high bits of the generator choose the line, because its low bits are not random.
  static constexpr std::uint32_t kStatesPerLine =
      static_cast<std::uint32_t>((std::uint64_t{1} << 32) / (kBytes / kLine));

  std::vector<float> buffer_;
  std::uint32_t state_ = 1;
};

/// Returns a vector that depends on all inputs and computes nothing else, so that its time is that
/// of everything around a sampler.
struct EmptySampler {
  template <class T>
  Vec3<T> sample(const Vec3<T>& wi, const Alpha<T>& alpha, T u1, T u2) const noexcept {
    return {wi.x + alpha.x, wi.y + alpha.y, wi.z + u1 + u2};
  }
};

}  // namespace vndf::bench
