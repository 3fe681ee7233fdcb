// Random numbers of one block of samples. They follow from the seed and from which block it is, so
// that results do not depend on which thread runs the block, nor on how many threads there are.
#pragma once

#include <algorithm>
#include <cstdint>
#include <random>

#include "vndf/validate/exact/configuration.h"

namespace vndf::validate {

/// A generator of its own for each block.
class BlockRandom {
 public:
  /// The numbers of block `block` of stream `stream` < 2^32. Streams of one seed are independent,
  /// as are blocks of one stream.
  BlockRandom(std::uint64_t seed, std::uint64_t stream, std::uint64_t block) {
    const auto low = [](std::uint64_t v) { return static_cast<std::uint32_t>(v); };
    std::seed_seq sequence{low(seed), low(seed >> 32), low(stream), low(block), low(block >> 32)};
    random_.seed(sequence);
  }

  /// A whole multiple of 2^-53 in [0, 1).
  double uniform() { return static_cast<double>(random_() >> 11) * 0x1p-53; }
  /// A number of single precision in (0, 1), rounded at its own scale: near 0 it has all its
  /// digits, so that samples fill the tail there and not a lattice in it.
  double single() { return std::min(to_single(uniform() + 0x1p-54), 1 - 0x1p-24); }

 private:
  std::mt19937_64 random_;
};

}  // namespace vndf::validate
