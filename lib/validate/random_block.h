// Random numbers of one block of samples, which follow from the seed and from where the block is:
// blocks run in any order, on any number of threads, and the samples are the same.
#pragma once

#include <algorithm>
#include <cstdint>
#include <random>

#include "validate/configuration.h"

namespace vndf::validate {

/// `configuration` is any number that tells the streams of one seed apart.
class RandomBlock {
 public:
  RandomBlock(std::uint64_t seed, std::uint64_t configuration, std::uint64_t block) {
    const auto half = [](std::uint64_t v) { return static_cast<std::uint32_t>(v >> 32); };
    const auto low = [](std::uint64_t v) { return static_cast<std::uint32_t>(v); };
    std::seed_seq sequence{half(seed), low(seed), low(configuration), half(block), low(block)};
    random_.seed(sequence);
  }
  /// Uniform in (0, 1) as a single-precision number, rounded at its own scale: near 0 it has all
  /// its digits, so that the tail there is a tail and no lattice.
  double single() {
    const double u = (static_cast<double>(random_() >> 11) + 0.5) * 0x1p-53;
    return std::min(to_single(u), 1 - 0x1p-24);
  }
  double full() { return (static_cast<double>(random_() >> 11) + 0.5) * 0x1p-53; }

 private:
  std::mt19937_64 random_;
};

}  // namespace vndf::validate
