// The names in which the kernel is written, for a device that computes as badly as one may, or
// worse. Vulkan, Metal and Direct3D let a device fuse a product with a sum, and round quotients,
// roots and powers less well than IEEE 754 does. Here each of these errs at random, as in Monte
// Carlo arithmetic (Parker 1997), by as much as the specification of Vulkan 1.3 (Precision and
// Operation of SPIR-V Instructions) lets it, times an excess. Sums are rounded correctly
// everywhere.
//
//   a * b     1 unit in the last place where the product is rounded at all, which is what a fused
//             product changes
//   a / b     3 units
//   sqrt(a)   3 units
//   exp2(a)   3 + 2 |a| units
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "vndf/kernel.h"

namespace vndf::devices::rough {

using kernel::make_uint4;
using kernel::uint;
using kernel::uint4;

/// A device of this kind: its errors follow from the seed, and are up to `excess` times those that
/// are allowed.
struct Device {
  std::uint64_t seed = 0;
  int excess = 1;
};

/// The device that computes on this thread. An operator has no other way to know it.
inline thread_local Device device;

/// A random whole number from -most to most (Steele, Lea and Flood 2014: SplitMix).
inline int random_between(int most) {
  std::uint64_t z = device.seed += 0x9e3779b97f4a7c15;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
  z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
  const auto count = static_cast<std::uint64_t>(2 * most + 1);
  return static_cast<int>((z >> 33) % count) - most;
}

/// `a` with an error where a device may err by up to `units` in the last place. Numbers too small
/// to have all their digits become 0, as devices may do.
inline float disturbed(float a, int units) {
  if (!std::isfinite(a)) return a;
  if (std::fabs(a) < kernel::kVndfLeast) return std::copysign(0.0f, a);
  const int error = random_between(device.excess * units);
  return kernel::float_of(kernel::bits_of(a) + static_cast<uint>(error));
}

/// A number of such a device.
class Number {
 public:
  Number() = default;
  constexpr Number(float value) : value_(value) {}
  float value() const { return value_; }

  friend Number operator+(Number a, Number b) { return a.value_ + b.value_; }
  friend Number operator-(Number a, Number b) { return a.value_ - b.value_; }
  friend Number operator-(Number a) { return -a.value_; }
  friend Number operator*(Number a, Number b) {
    const float product = a.value_ * b.value_;
    const bool exact = std::fma(a.value_, b.value_, -product) == 0.0f;
    return exact && std::fabs(product) >= kernel::kVndfLeast ? product : disturbed(product, 1);
  }
  friend Number operator/(Number a, Number b) { return disturbed(a.value_ / b.value_, 3); }
  friend bool operator==(Number a, Number b) { return a.value_ == b.value_; }
  friend bool operator<(Number a, Number b) { return a.value_ < b.value_; }
  friend bool operator>(Number a, Number b) { return a.value_ > b.value_; }
  friend bool operator<=(Number a, Number b) { return a.value_ <= b.value_; }
  friend bool operator>=(Number a, Number b) { return a.value_ >= b.value_; }

 private:
  float value_;
};

inline uint bits_of(Number a) {
  return kernel::bits_of(a.value());
}
inline Number float_of(uint a) {
  return kernel::float_of(a);
}
inline Number magnitude(Number a) {
  return std::fabs(a.value());
}
inline Number smaller(Number a, Number b) {
  return a < b ? a : b;
}
inline Number larger(Number a, Number b) {
  return a > b ? a : b;
}
inline Number square_root(Number a) {
  return disturbed(std::sqrt(a.value()), 3);
}
inline Number power_of_two(Number a) {
  const int most = 3 + static_cast<int>(2 * std::min(std::fabs(a.value()), 150.0f));
  return disturbed(std::exp2(a.value()), most);
}

struct vec2 {
  Number x, y;
};
struct vec3 {
  Number x, y, z;
};
inline vec2 make2(Number x, Number y) {
  return {x, y};
}
inline vec3 make3(Number x, Number y, Number z) {
  return {x, y, z};
}

/// Four numbers that are worked on side by side.
struct float4 {
  Number lane[4];
  Number operator[](int k) const { return lane[k]; }
};
inline float4 make4(Number a, Number b, Number c, Number d) {
  return {{a, b, c, d}};
}
template <class F>
float4 each(F f) {
  return {{f(0), f(1), f(2), f(3)}};
}
inline float4 operator+(const float4& a, const float4& b) {
  return each([&](int k) { return a[k] + b[k]; });
}
inline float4 operator-(const float4& a, const float4& b) {
  return each([&](int k) { return a[k] - b[k]; });
}
inline float4 operator*(const float4& a, const float4& b) {
  return each([&](int k) { return a[k] * b[k]; });
}
inline float4 operator*(Number a, const float4& b) {
  return each([&](int k) { return a * b[k]; });
}
inline float4 smaller(const float4& a, const float4& b) {
  return each([&](int k) { return smaller(a[k], b[k]); });
}
inline float4 larger(const float4& a, const float4& b) {
  return each([&](int k) { return larger(a[k], b[k]); });
}
inline float4 square_root(const float4& a) {
  return each([&](int k) { return square_root(a[k]); });
}
inline float4 nearest_whole(const float4& a) {
  return each([&](int k) { return a[k] > 0.5f ? Number(1) : Number(0); });
}
inline uint4 bits_of(const float4& a) {
  return make_uint4(bits_of(a[0]), bits_of(a[1]), bits_of(a[2]), bits_of(a[3]));
}
inline float4 floats_of(const uint4& a) {
  return each([&](int k) { return float_of(a[k]); });
}
/// All bits of the lanes whose sign bit is set.
inline uint4 sign_mask(const float4& a) {
  const auto mask = [&](int k) { return 0u - (bits_of(a[k]) >> 31); };
  return make_uint4(mask(0), mask(1), mask(2), mask(3));
}
/// (a0, a1, b0, b1), (a2, a3, b2, b3) and (a1, a1, a3, a3).
inline float4 low_halves(const float4& a, const float4& b) {
  return make4(a[0], a[1], b[0], b[1]);
}
inline float4 high_halves(const float4& a, const float4& b) {
  return make4(a[2], a[3], b[2], b[3]);
}
inline float4 odd_lanes(const float4& a) {
  return make4(a[1], a[1], a[3], a[3]);
}

/// The bytes of the tables.
struct Block {
  const unsigned char* bytes;
};

/// An entry of a guide.
struct Guide {
  Number start;
  uint offset;
};
inline float4 fetch4(Block block, uint offset, uint k) {
  const kernel::float4 four = kernel::fetch4({block.bytes}, offset, k);
  return make4(four[0], four[1], four[2], four[3]);
}
inline Guide fetch_guide(Block block, uint offset) {
  const kernel::Guide entry = kernel::fetch_guide({block.bytes}, offset);
  return {entry.start, entry.offset};
}

}  // namespace vndf::devices::rough
