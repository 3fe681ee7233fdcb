// The numbers that a path consumes: points that fill [0, 1)^2 more evenly than random ones, so that
// an image needs fewer paths. Each pair of dimensions is its own copy of Sobol's first two
// dimensions, whose order is shuffled and whose digits are scrambled as Owen does (padding), by the
// hash functions of Burley, Practical Hash-based Owen Scrambling, Journal of Computer Graphics
// Techniques 9 (4), 2020. The mean of every estimate is that of random numbers.
#pragma once

#include <cstdint>

#include "vndf/vec.h"

namespace vndf::render {

/// Mixes `x` so that inputs that differ in a bit give unrelated results (the finaliser of
/// SplitMix64).
inline std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

inline std::uint32_t reversed_bits(std::uint32_t x) {
  x = (x >> 16) | (x << 16);
  x = ((x & 0x00ff00ffu) << 8) | ((x & 0xff00ff00u) >> 8);
  x = ((x & 0x0f0f0f0fu) << 4) | ((x & 0xf0f0f0f0u) >> 4);
  x = ((x & 0x33333333u) << 2) | ((x & 0xccccccccu) >> 2);
  return ((x & 0x55555555u) << 1) | ((x & 0xaaaaaaaau) >> 1);
}

/// Owen's scrambling of the binary digits of `x`: whether a digit is flipped depends on `seed` and
/// on the digits above it. The permutation of Laine and Karras does so from below, hence the
/// reversals.
inline std::uint32_t owen_scrambled(std::uint32_t x, std::uint32_t seed) {
  x = reversed_bits(x) + seed;
  x ^= x * 0x6c50b47cu;
  x ^= x * 0xb82f1e52u;
  x ^= x * 0xc7afe638u;
  x ^= x * 0x8d22f6e6u;
  return reversed_bits(x);
}

/// The second of Sobol's dimensions; the first is reversed_bits().
inline std::uint32_t second_sobol(std::uint32_t index) {
  std::uint32_t x = 0;
  for (std::uint32_t digit = 0x80000000u; index != 0; index >>= 1, digit ^= digit >> 1)
    if (index & 1u) x ^= digit;
  return x;
}

/// The numbers of one path, in [0, 1). The first 2^k paths of a pixel have one point in each of the
/// 2^k boxes of every shape that halving makes of [0, 1)^2, in each of their pairs. Paths of other
/// pixels and seeds are independent.
class SampleSequence {
 public:
  SampleSequence(std::uint64_t seed, std::uint64_t pixel, std::uint32_t path)
      : key_(mixed(mixed(seed) ^ pixel)), path_(path) {}

  Vec2<float> next_pair() {
    const std::uint64_t key = mixed(key_ + dimension_++), digits = mixed(key);
    // Scrambling an index shuffles the sequence, every block of 2^k within itself.
    const std::uint32_t index = owen_scrambled(path_, static_cast<std::uint32_t>(key));
    return {unit(owen_scrambled(reversed_bits(index), static_cast<std::uint32_t>(digits))),
            unit(owen_scrambled(second_sobol(index), static_cast<std::uint32_t>(digits >> 32)))};
  }
  float next() { return next_pair().x; }

 private:
  static float unit(std::uint32_t x) { return static_cast<float>(x >> 8) * 0x1p-24f; }

  std::uint64_t key_;
  std::uint32_t path_;
  std::uint64_t dimension_ = 0;
};

}  // namespace vndf::render
