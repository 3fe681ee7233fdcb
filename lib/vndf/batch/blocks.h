// How a batch is cut into blocks: a sampler works on kBlock samples at a time, in steps between
// which the block rests in arrays that the first-level cache holds.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

namespace vndf::batch {

/// Samples in a block: a multiple of the lanes of any target, few enough that twenty arrays, 6 KiB,
/// leave the cells in use their place in the first-level cache.
inline constexpr std::size_t kBlock = 64;
/// Most lanes that a kernel uses.
inline constexpr std::size_t kMaxLanes = 16;

/// One number for each sample of a block, with room for a vector that begins at the last of them.
template <class T>
struct alignas(64) Lanes {
  std::array<T, kBlock + kMaxLanes> at;

  T* data() { return at.data(); }
  const T* data() const { return at.data(); }
};

/// An input, one number for each sample or one for all, read a block at a time.
class Input {
 public:
  explicit Input(std::span<const float> values) : values_(values), each_(true) {}
  explicit Input(float value) { block_.at.fill(value); }

  /// The numbers of the block that begins at sample `begin`. A last block that is not full ends
  /// with zeros.
  const float* block(std::size_t begin) {
    if (!each_) return block_.data();
    if (values_.size() - begin >= kBlock) return &values_[begin];
    block_.at.fill(0);
    std::copy(values_.begin() + static_cast<std::ptrdiff_t>(begin), values_.end(),
              block_.at.begin());
    return block_.data();
  }

 private:
  std::span<const float> values_;
  bool each_ = false;
  Lanes<float> block_;
};

/// Where the results of a block go: straight to the output, or the last ones through an array.
class Output {
 public:
  explicit Output(std::span<float> values) : values_(values) {}

  float* block(std::size_t begin) {
    return values_.size() - begin >= kBlock ? &values_[begin] : block_.data();
  }
  /// Called when the block is done.
  void finish(std::size_t begin) {
    const std::size_t left = values_.size() - begin;
    if (left < kBlock) std::copy_n(block_.data(), left, &values_[begin]);
  }

 private:
  std::span<float> values_;
  Lanes<float> block_;
};

}  // namespace vndf::batch
