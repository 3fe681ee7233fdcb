// Part 1 of kernel_text.h: what the tables are, and how a place on an axis leads to a cubic.

/// A curve: where its segments are, each of four entries of a guide, and how many.
struct VndfCurve {
  uint segments, count;
};

/// What directions below the horizon have of their own.
struct VndfBelow {
  /// In units of U: nothing is visible from a cotangent of minus it, nor from lower ones. It is 0
  /// where the tables have nothing for directions below the horizon.
  float most_cotangent;
  float least_place;  ///< on the axis of incidence: lower directions take the row there
  uint direction_guide, direction_shift;
  uint marginal_guide, conditional_guide;
  uint slope_guide, slope_shift;  ///< of rows of y
  float slope_most;               ///< largest place on their axis
};

/// What of the header of the tables the functions read.
struct VndfTables {
  float unit;            ///< U: slope at unit roughness for each 1 of x
  float scale_root;      ///< the scale of y is scale_root sqrt(1 + x^2) + scale_constant,
  float scale_constant;  ///< or sqrt(rim^2 - x^2) where the rim is not 0
  float rim;
  float least_root, most_root;     ///< bounds of the root of sigma: no normal is horizontal
  float direction_offset;          ///< of the axis of incidence
  float slope_middle;              ///< s of x = 0
  float slope_offset, slope_most;  ///< least and largest p on the axis of slopes
  uint direction_guide, direction_shift;
  uint column_shift;
  uint column_upper;  ///< what is added to the bits of -p for u1 above one half
  uint column_roots;  ///< 1 where p is a root, 0 where it is q
  float column_offset;
  float column_span;   ///< what p of u2 and its mirror add up to
  uint column_mirror;  ///< what is added to the bits of a mirrored p
  uint marginal_guide, conditional_guide;
  uint slope_guide, slope_shift;  ///< with two entries a key: of the map, and of rows of y
  uint slope_upper;               ///< what is added to the bits of p for s above slope_middle
  uint kind;                      ///< kVndfPlain or kVndfAny
  uint separable;  ///< 1 where y over its scale does not depend on x, 0 where it has rows in x
  VndfCurve ndf, backfacing;
  VndfBelow below;
  Block block;
};

/// An incident direction and roughness after step 1: what a sample needs of them.
struct VndfDirection {
  float alpha_x, alpha_y;
  float x, y, z;  ///< stretched; z / h = cot(theta)
  float h2, hu;   ///< h^2 = x^2 + y^2, and h U
  float g;        ///< place in its row of patches
  uint row;       ///< bytes from the first row to it
  uint kind;      ///< kVndfPlain, kVndfAny or, below the horizon, kVndfBelow
  float edge;     ///< what the values of patches are multiplied by below the horizon
};

/// Step 2 of one sample: the slope, and the cubics that gave it, of which the density needs the
/// derivatives.
struct VndfDraw {
  float4 marginal, map, conditional;
  float s, map_f;  ///< s, and the place in the map's cell; set where the map was used
  float4 f;        ///< place in the cell: of u1 in two lanes, of u2 in two
  uint4 upper;     ///< all bits where u is above one half, in the same lanes
  float4 places;   ///< on the axis of columns, in the same lanes
  float root;      ///< root of sigma, which stands for slope x
  float v;         ///< slope y over its scale
  uint second;     ///< where the coefficients of the column of u2 begin
};

VNDF_CONSTANT float kVndfLeastU = 2.98023224e-8f;  // 2^-25
VNDF_CONSTANT float kVndfMostU = 0.999999940395f;  // 1 - 2^-24
// Between these h^2 has all its digits and no product with it overflows.
VNDF_CONSTANT float kVndfShortest = 1e-12f;
VNDF_CONSTANT float kVndfLongest = 1e12f;
VNDF_CONSTANT float kVndfLeast = 1.17549435e-38f;       // the least number that has all its digits
VNDF_CONSTANT float kVndfMiddleRoot = 0.707106781187f;  // root of sigma at slope 0
VNDF_CONSTANT float kVndfLargest =
    3.402823466e38f;  // the largest; a density where many u give one normal
VNDF_CONSTANT float kVndfFarthest = 1.26765060e30f;  // 2^100; curves take slopes beyond it for it
// The kind of tables that a function is compiled for. Plain tables are separable, without a rim,
// and have columns by q, which saves instructions; the functions for any tables are right for all.
VNDF_CONSTANT uint kVndfPlain = 0u;
VNDF_CONSTANT uint kVndfAny = 1u;
// The same for a direction below the horizon, which has patches of its own.
VNDF_CONSTANT uint kVndfBelow = 2u;
VNDF_CONSTANT uint kVndfSign = 0x80000000u;

/// Whether `a` is in [low, high), both positive. One comparison of bits tells, also where `a` is
/// not a number, because the bits of positive numbers are ordered as they are.
VNDF_FUNCTION bool vndf_within(float a, float low, float high) {
  return bits_of(a) - bits_of(low) < bits_of(high) - bits_of(low);
}

/// The place in a cell, and where the coefficients of the cell are: bytes from the first.
struct VndfCell {
  float f;
  uint offset;
};

VNDF_FUNCTION VndfCell vndf_cell(VNDF_IN(VndfTables) t, uint guide, uint shift, float place) {
  Guide entry = fetch_guide(t.block, guide + ((bits_of(place) >> shift) << 3));
  VndfCell cell;
  cell.f = place - entry.start;
  cell.offset = entry.offset;
  return cell;
}

/// The cubic of the patch whose coefficients begin at `first`, at the place `g` in its row: a patch
/// is a cubic in g of cubics.
VNDF_FUNCTION float4 vndf_blend(VNDF_IN(VndfTables) t, uint first, float g) {
  float4 low = fetch4(t.block, first, 0u) + g * fetch4(t.block, first, 1u);
  float4 high = fetch4(t.block, first, 2u) + g * fetch4(t.block, first, 3u);
  return low + (g * g) * high;
}

/// The values of two cubics, of `a` at f[0] in lane 0 and of `b` at f[2] in lane 2.
VNDF_FUNCTION float4 vndf_values(float4 a, float4 b, float4 f) {
  float4 lines = low_halves(a, b) + f * high_halves(a, b);
  return lines + (f * f) * odd_lanes(lines);
}

/// The value of a cubic at f.
VNDF_FUNCTION float vndf_value(float4 a, float f) {
  return vndf_values(a, a, make4(f, f, f, f))[0];
}

/// The derivative of a cubic at f.
VNDF_FUNCTION float vndf_rate(float4 a, float f) {
  return a[2] + f * (2.0f * a[1] + f * (3.0f * a[3]));
}
