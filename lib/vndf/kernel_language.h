// The names in which kernel_text.h is written, for C++ and CUDA: vectors of four, bit casts and
// fetches from the block of tables. Another language gives the same names to its own.
//
// Compiler vectors are used where there are any, unless VNDF_PORTABLE is defined. The portable
// struct computes the same bits, operation by operation. Define VNDF_PORTABLE for a whole program
// or not at all, because functions of both kinds have the same names. C++17 is enough, because
// tables are exported to renderers that are no newer.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#if defined(__SSE2__) && defined(__GNUC__) && !defined(__CUDACC__) && !defined(VNDF_PORTABLE)
// Compilers make jumps of some minima, which random numbers mispredict, and calls of square roots.
#define VNDF_SSE 1
#include <emmintrin.h>
#else
#define VNDF_SSE 0
#endif

#include "vndf/vec.h"

#ifdef __CUDACC__
#define VNDF_FUNCTION __host__ __device__ inline
#elif defined(__GNUC__)
#define VNDF_FUNCTION [[gnu::always_inline]] inline
#else
#define VNDF_FUNCTION inline
#endif

/// A function that is called and not put in place, so that it takes no registers from its callers.
/// It is pure, which tells compilers that no store can change what it reads.
#if defined(__GNUC__) && !defined(__CUDACC__)
#define VNDF_APART_FUNCTION [[gnu::noinline, gnu::pure]] inline
#else
#define VNDF_APART_FUNCTION VNDF_FUNCTION
#endif

/// A function that is seldom called and must not enlarge its callers.
#if defined(__GNUC__) && !defined(__CUDACC__)
#define VNDF_COLD_FUNCTION [[gnu::noinline, gnu::cold]] inline
#else
#define VNDF_COLD_FUNCTION VNDF_FUNCTION
#endif

/// A number that is known when the text is compiled.
#define VNDF_CONSTANT constexpr
/// A parameter that a function reads.
#define VNDF_IN(type) const type&
/// A condition that hardly ever holds.
#if __cplusplus >= 202002L
#define VNDF_RARELY(condition) (condition) [[unlikely]]
#else
#define VNDF_RARELY(condition) (condition)
#endif

#if defined(__GNUC__) && !defined(__CUDACC__) && !defined(VNDF_PORTABLE)
#define VNDF_VECTORS 1
#else
#define VNDF_VECTORS 0
#endif

namespace vndf::kernel {

using uint = std::uint32_t;
using vec3 = Vec3<float>;
using vec2 = Vec2<float>;

#if VNDF_VECTORS
typedef float float4 __attribute__((vector_size(16)));
typedef uint uint4 __attribute__((vector_size(16)));
#else
/// Four numbers that are worked on side by side.
template <class V>
struct Four {
  V lane[4];
  VNDF_FUNCTION V operator[](int k) const { return lane[k]; }
};
using float4 = Four<float>;
using uint4 = Four<uint>;

template <class V, class F>
VNDF_FUNCTION auto each(F f) {
  return Four<V>{{f(0), f(1), f(2), f(3)}};
}
VNDF_FUNCTION float4 operator+(const float4& a, const float4& b) {
  return each<float>([&](int k) { return a[k] + b[k]; });
}
VNDF_FUNCTION float4 operator-(const float4& a, const float4& b) {
  return each<float>([&](int k) { return a[k] - b[k]; });
}
VNDF_FUNCTION float4 operator*(const float4& a, const float4& b) {
  return each<float>([&](int k) { return a[k] * b[k]; });
}
VNDF_FUNCTION float4 operator*(float a, const float4& b) {
  return each<float>([&](int k) { return a * b[k]; });
}
VNDF_FUNCTION float4 operator+(const float4& a, float b) {
  return each<float>([&](int k) { return a[k] + b; });
}
VNDF_FUNCTION float4 operator-(const float4& a, float b) {
  return each<float>([&](int k) { return a[k] - b; });
}
VNDF_FUNCTION uint4 operator+(const uint4& a, const uint4& b) {
  return each<uint>([&](int k) { return a[k] + b[k]; });
}
VNDF_FUNCTION uint4 operator&(const uint4& a, const uint4& b) {
  return each<uint>([&](int k) { return a[k] & b[k]; });
}
VNDF_FUNCTION uint4 operator>>(const uint4& a, uint b) {
  return each<uint>([&](int k) { return a[k] >> b; });
}
#endif

VNDF_FUNCTION vec3 make3(float x, float y, float z) {
  return {x, y, z};
}
VNDF_FUNCTION vec2 make2(float x, float y) {
  return {x, y};
}
VNDF_FUNCTION float4 make4(float a, float b, float c, float d) {
  return float4{a, b, c, d};
}
VNDF_FUNCTION uint4 make_uint4(uint a, uint b, uint c, uint d) {
  return uint4{a, b, c, d};
}

VNDF_FUNCTION uint bits_of(float a) {
  uint bits;
  std::memcpy(&bits, &a, sizeof bits);
  return bits;
}
VNDF_FUNCTION float float_of(uint a) {
  float value;
  std::memcpy(&value, &a, sizeof value);
  return value;
}

VNDF_FUNCTION float magnitude(float a) {
  return std::fabs(a);
}

// Each returns its second argument if one of the two is not a number.
#if VNDF_SSE && defined(__AVX__)
VNDF_FUNCTION float smaller(float a, float b) {
  __asm__("vminss %1, %0, %0" : "+x"(a) : "x"(b));
  return a;
}
VNDF_FUNCTION float larger(float a, float b) {
  __asm__("vmaxss %1, %0, %0" : "+x"(a) : "x"(b));
  return a;
}
#elif VNDF_SSE
VNDF_FUNCTION float smaller(float a, float b) {
  __asm__("minss %1, %0" : "+x"(a) : "x"(b));
  return a;
}
VNDF_FUNCTION float larger(float a, float b) {
  __asm__("maxss %1, %0" : "+x"(a) : "x"(b));
  return a;
}
#else
VNDF_FUNCTION float smaller(float a, float b) {
  return a < b ? a : b;
}
VNDF_FUNCTION float larger(float a, float b) {
  return a > b ? a : b;
}
#endif

#if VNDF_VECTORS
VNDF_FUNCTION uint4 bits_of(float4 a) {
  return reinterpret_cast<uint4>(a);
}
/// All bits of the lanes whose sign bit is set.
VNDF_FUNCTION uint4 sign_mask(float4 a) {
  typedef std::int32_t int4 __attribute__((vector_size(16)));
  return reinterpret_cast<uint4>(reinterpret_cast<int4>(a) >> 31);
}
#if VNDF_SSE
VNDF_FUNCTION float4 smaller(float4 a, float4 b) {
  return _mm_min_ps(a, b);
}
VNDF_FUNCTION float4 larger(float4 a, float4 b) {
  return _mm_max_ps(a, b);
}
#else
VNDF_FUNCTION float4 smaller(float4 a, float4 b) {
  return a < b ? a : b;
}
VNDF_FUNCTION float4 larger(float4 a, float4 b) {
  return a > b ? a : b;
}
#endif
/// (a0, a1, b0, b1) and (a2, a3, b2, b3).
VNDF_FUNCTION float4 low_halves(float4 a, float4 b) {
  return __builtin_shufflevector(a, b, 0, 1, 4, 5);
}
VNDF_FUNCTION float4 high_halves(float4 a, float4 b) {
  return __builtin_shufflevector(a, b, 2, 3, 6, 7);
}
/// (a1, a1, a3, a3).
VNDF_FUNCTION float4 odd_lanes(float4 a) {
  return __builtin_shufflevector(a, a, 1, 1, 3, 3);
}
#else
VNDF_FUNCTION uint4 bits_of(const float4& a) {
  return each<uint>([&](int k) { return bits_of(a[k]); });
}
VNDF_FUNCTION uint4 sign_mask(const float4& a) {
  return each<uint>([&](int k) { return bits_of(a[k]) >> 31 != 0 ? ~0u : 0u; });
}
VNDF_FUNCTION float4 smaller(const float4& a, const float4& b) {
  return each<float>([&](int k) { return smaller(a[k], b[k]); });
}
VNDF_FUNCTION float4 larger(const float4& a, const float4& b) {
  return each<float>([&](int k) { return larger(a[k], b[k]); });
}
VNDF_FUNCTION float4 low_halves(const float4& a, const float4& b) {
  return float4{a[0], a[1], b[0], b[1]};
}
VNDF_FUNCTION float4 high_halves(const float4& a, const float4& b) {
  return float4{a[2], a[3], b[2], b[3]};
}
VNDF_FUNCTION float4 odd_lanes(const float4& a) {
  return float4{a[1], a[1], a[3], a[3]};
}
#endif

VNDF_FUNCTION float square_root(float a) {
#if VNDF_SSE && defined(__AVX__)
  __asm__("vsqrtss %0, %0, %0" : "+x"(a));
  return a;
#elif VNDF_SSE
  __asm__("sqrtss %0, %0" : "+x"(a));
  return a;
#else
  return std::sqrt(a);
#endif
}

#if VNDF_SSE
VNDF_FUNCTION float4 square_root(float4 a) {
  return _mm_sqrt_ps(a);
}
#else
VNDF_FUNCTION float4 square_root(VNDF_IN(float4) a) {
  return make4(square_root(a[0]), square_root(a[1]), square_root(a[2]), square_root(a[3]));
}
#endif

/// 0 for a number from 0 to one half, 1 for one above up to 1: adding and taking away 1.5 x 2^23
/// rounds.
VNDF_FUNCTION float4 nearest_whole(VNDF_IN(float4) a) {
  float4 large = make4(12582912.0f, 12582912.0f, 12582912.0f, 12582912.0f);
  return (a + large) - large;
}

/// 2^a.
VNDF_FUNCTION float power_of_two(float a) {
  return std::exp2(a);
}

#if VNDF_VECTORS
VNDF_FUNCTION float4 floats_of(uint4 a) {
  return reinterpret_cast<float4>(a);
}
#else
VNDF_FUNCTION float4 floats_of(const uint4& a) {
  return each<float>([&](int k) { return float_of(a[k]); });
}
VNDF_FUNCTION uint4 operator^(const uint4& a, const uint4& b) {
  return each<uint>([&](int k) { return a[k] ^ b[k]; });
}
#endif

/// The bytes of the tables. Fetches give the distance from the first of them.
struct Block {
  const unsigned char* bytes;
};

/// An entry of a guide: where a cell of an axis begins, and where its coefficients are.
struct Guide {
  float start;
  uint offset;
};

/// Four coefficients, the k-th of those that begin at `offset`, a multiple of 16. The bytes may be
/// those of an array of any type.
VNDF_FUNCTION float4 fetch4(Block block, uint offset, uint k) {
#if VNDF_VECTORS
  typedef float4 any4 __attribute__((may_alias));
  return reinterpret_cast<const any4*>(block.bytes + offset)[k];
#else
  const void* from = block.bytes + offset + 16 * std::size_t{k};
#ifdef __CUDACC__
  from = __builtin_assume_aligned(from, 16);
#endif
  float4 value;
  std::memcpy(&value, from, sizeof value);
  return value;
#endif
}

/// An entry of a guide, at a multiple of 8. CUDA reads both parts at once; elsewhere they go to
/// registers of two kinds, so that each is read on its own.
VNDF_FUNCTION Guide fetch_guide(Block block, uint offset) {
  Guide value;
#ifdef __CUDACC__
  std::memcpy(&value, __builtin_assume_aligned(block.bytes + offset, 8), sizeof value);
#else
  std::memcpy(&value.start, block.bytes + offset, sizeof value.start);
  std::memcpy(&value.offset, block.bytes + offset + sizeof value.start, sizeof value.offset);
#endif
  return value;
}

}  // namespace vndf::kernel
