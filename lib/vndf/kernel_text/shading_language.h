// The names in which the kernel is written, for the shading languages: GLSL, HLSL and Metal. They
// differ in the words of types and of bit casts, and in Block and word_of(), by which a word of 16
// bytes of the tables is read. translate() of vndf/devices gives each language its own. C++ and
// CUDA have kernel_language.h.

VNDF_FUNCTION vec3 make3(float x, float y, float z) {
  return vec3(x, y, z);
}
VNDF_FUNCTION vec2 make2(float x, float y) {
  return vec2(x, y);
}
VNDF_FUNCTION float4 make4(float a, float b, float c, float d) {
  return float4(a, b, c, d);
}
VNDF_FUNCTION uint4 make_uint4(uint a, uint b, uint c, uint d) {
  return uint4(a, b, c, d);
}

VNDF_FUNCTION uint bits_of(float a) {
  return as_uint(a);
}
VNDF_FUNCTION uint4 bits_of(float4 a) {
  return as_uint4(a);
}
VNDF_FUNCTION float float_of(uint a) {
  return as_float(a);
}
VNDF_FUNCTION float4 floats_of(uint4 a) {
  return as_float4(a);
}
/// All bits of the lanes whose sign bit is set.
VNDF_FUNCTION uint4 sign_mask(float4 a) {
  return make_uint4(0u, 0u, 0u, 0u) - (bits_of(a) >> 31u);
}

VNDF_FUNCTION float magnitude(float a) {
  return abs(a);
}
VNDF_FUNCTION float square_root(float a) {
  return sqrt(a);
}
VNDF_FUNCTION float4 square_root(float4 a) {
  return sqrt(a);
}
/// 2^a.
VNDF_FUNCTION float power_of_two(float a) {
  return exp2(a);
}

// Each returns its second argument if one of the two is not a number, which min() need not.
VNDF_FUNCTION float smaller(float a, float b) {
  return a < b ? a : b;
}
VNDF_FUNCTION float larger(float a, float b) {
  return a > b ? a : b;
}
VNDF_FUNCTION float4 smaller(float4 a, float4 b) {
  return make4(smaller(a.x, b.x), smaller(a.y, b.y), smaller(a.z, b.z), smaller(a.w, b.w));
}
VNDF_FUNCTION float4 larger(float4 a, float4 b) {
  return make4(larger(a.x, b.x), larger(a.y, b.y), larger(a.z, b.z), larger(a.w, b.w));
}

/// 0 for a number up to one half, 1 for one above. Drivers take the sum that rounds in C++ for the
/// number itself.
VNDF_FUNCTION float nearest_whole(float a) {
  return a > 0.5f ? 1.0f : 0.0f;
}
VNDF_FUNCTION float4 nearest_whole(float4 a) {
  return make4(nearest_whole(a.x), nearest_whole(a.y), nearest_whole(a.z), nearest_whole(a.w));
}

/// (a0, a1, b0, b1), (a2, a3, b2, b3) and (a1, a1, a3, a3).
VNDF_FUNCTION float4 low_halves(float4 a, float4 b) {
  return make4(a.x, a.y, b.x, b.y);
}
VNDF_FUNCTION float4 high_halves(float4 a, float4 b) {
  return make4(a.z, a.w, b.z, b.w);
}
VNDF_FUNCTION float4 odd_lanes(float4 a) {
  return make4(a.y, a.y, a.w, a.w);
}

/// An entry of a guide: where a cell of an axis begins, and where its coefficients are.
struct Guide {
  float start;
  uint offset;
};

/// Four coefficients, the k-th of those that begin at `offset`, a multiple of 16.
VNDF_FUNCTION float4 fetch4(Block block, uint offset, uint k) {
  return floats_of(word_of(block, (offset >> 4u) + k));
}

/// An entry of a guide, at a multiple of 8.
VNDF_FUNCTION Guide fetch_guide(Block block, uint offset) {
  uint4 word = word_of(block, offset >> 4u);
  Guide entry;
  entry.start = float_of((offset & 8u) == 0u ? word.x : word.z);
  entry.offset = (offset & 8u) == 0u ? word.y : word.w;
  return entry;
}
