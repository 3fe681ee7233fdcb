// Random numbers of one block of a check, which follow from the seed and from where the block
// is: results do not depend on which thread runs it, nor on how many there are.
#pragma once

#include <algorithm>
#include <cstdint>
#include <random>

#include "vndf/validate/exact/configuration.h"

namespace vndf::validate {

class BlockRandom {
 public:
  /// Of block `block` of stream `stream`, at most 2^32 streams.
  BlockRandom(std::uint64_t seed, std::uint64_t stream, std::uint64_t block) {
    const auto low = [](std::uint64_t v) { return static_cast<std::uint32_t>(v); };
    std::seed_seq sequence{low(seed), low(seed >> 32), low(stream), low(block), low(block >> 32)};
    random_.seed(sequence);
  }

  /// A whole multiple of 2^-53 in [0, 1).
  double uniform() { return static_cast<double>(random_() >> 11) * 0x1p-53; }
  /// A single-precision number in (0, 1), rounded at its own scale: near 0 it has all its digits,
  /// so that the tail there is a tail and no lattice.
  double single() { return std::min(to_single(uniform() + 0x1p-54), 1 - 0x1p-24); }

 private:
  std::mt19937_64 random_;
};

}  // namespace vndf::validate
