// The sampler that renderers run: Algorithm 4 of Heitz and d'Eon 2014 over baked tables, from which
// a sample takes two square roots, two divisions and two lookups whatever the distribution is.
//
// This text is written in the subset that C++, CUDA and GLSL share, over the names of
// kernel_language.h, so that no second copy of it can drift: no pointers, no containers, no
// templates, no recursion. Nothing here allocates, throws or touches errno.
//
// Slopes are in units of U, chosen when the tables were baked, and in the bounded form of
// table_coordinates.h, sigma = tau / (1 + tau), tau = x + sqrt(1 + x^2), so that
//
//   x = (sigma - 1/2) / d,   sqrt(1 + x^2) = (1/2 - d) / d,   d = sigma (1 - sigma).
//
// Every axis is a positive float whose leading bits, its exponent and some of its mantissa, index a
// guide. The guide tells the cell, where it begins and where its coefficients are, so that cells
// are fine where a table bends and no search is needed:
//
//   incidence   g + offset,  g = 1 / (1 + c),  c = cot(theta) in units of U: 0 at the pole, 1 at
//               grazing
//   u1          p = q below one half, a power of two times p above it, which keeps the halves
//               apart, q = min(u1, 1 - u1): both ends are seen in full relative precision. Where
//               tables are to be small p = sqrt(2 q) + an offset instead, in which x is smooth
//               towards c
//   u2          p, for the law is symmetric; slope_y has the sign of u2 - 1/2. Where rows of y are
//               needed too, p and its mirror in the middle of the axis, again a power of two apart:
//               hollow and pointed laws are steep at u2 = 1/2
//   slope x     |sigma - 1/2| + offset
//
//   s           s + an offset
//
// Where slope y over its scale does not depend on x, as for Beckmann, Student-T and GGX, the law is
// smooth: a cell of the marginal is a patch of 4 x 4 coefficients, cubic in u1 and in g, of the
// root of sigma, which bends less than sigma where the tail is heavy; and one of the conditional is
// a cubic in q of -|y| over the scale. Of any other law the marginal is a patch of s, in which it
// is smooth too, from which a cubic, the pair's map, makes the root; and the conditional is a patch
// in q and in x. In memory the four coefficients of a cubic are (c0, c2, c1, c3).

struct VndfCurve {
  uint segments, count;  ///< where they are, each of two fetches, and how many
};

/// The header of the tables, without what sampling does not read.
struct VndfTables {
  float unit;            ///< U: slope at unit roughness for each 1 of x
  float scale_root;      ///< the scale of y is scale_root sqrt(1 + x^2) + scale_constant, or
  float scale_constant;  ///< sqrt(rim^2 - x^2) where the rim is not 0
  float rim;
  float least_root, most_root;  ///< of sigma, so that no normal is horizontal
  float direction_offset;
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
  uint slope_upper;               ///< what is added to the bits of p for s above one half
  uint kind;                      ///< kVndfPlain or kVndfAny
  uint separable;  ///< 1 where y over its scale does not depend on x, 0 where it has rows in x
  VndfCurve ndf, backfacing;
  Block block;
};

/// A direction towards which normals are drawn, and what of step 1 a sample needs.
struct VndfDirection {
  float alpha_x, alpha_y;
  float x, y, z;  ///< stretched; z / h = cot(theta)
  float h2, hu;   ///< h^2 = x^2 + y^2, and h U
  float g;        ///< place in the row of patches
  uint row;       ///< distance of the row from the first
};

/// The cubics of one sample and what they gave.
struct VndfDraw {
  float4 marginal, map, conditional;
  float s, map_f;  ///< what the map is of, and the place in its cell
  float4 f;        ///< place in the cells: of u1 twice, of q twice
  uint4 upper;     ///< all bits where u is above one half, likewise
  float4 places;   ///< of u1 on the axis of columns, a power of two apart above one half; of q
  float root;      ///< of sigma, which stands for slope x
  float v;         ///< slope y over its scale
};

const float kVndfLeastU = 2.98023224e-8f;  // 2^-25
const float kVndfMostU = 0.999999940395f;  // 1 - 2^-24
// Of h^2, between which all its digits are kept and no product overflows.
const float kVndfShortest = 1e-12f;
const float kVndfLongest = 1e12f;
const float kVndfLeast = 1.17549435e-38f;    // of the numbers that keep their digits
const float kVndfLargest = 3.402823466e38f;  // a density where many u give one normal
const float kVndfFarthest = 1.26765060e30f;  // 2^100: slopes beyond it are taken for it
// What is known of tables when a sampler is compiled: that they are separable, without a rim, and
// their columns by q; or nothing, which is right for all.
const uint kVndfPlain = 0u;
const uint kVndfAny = 1u;
const uint kVndfSign = 0x80000000u;

/// Whether a is in [low, high), two positive numbers; one comparison of bits, in which what is no
/// number is above all others.
VNDF_FUNCTION bool vndf_within(float a, float low, float high) {
  return bits_of(a) - bits_of(low) < bits_of(high) - bits_of(low);
}

/// Where in its cell a place on an axis is, with the distance that the guide gives.
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

/// The cubic of a patch at the place `g` in its row.
VNDF_FUNCTION float4 vndf_blend(VNDF_IN(VndfTables) t, uint patch, float g) {
  float4 low = fetch4(t.block, patch, 0u) + g * fetch4(t.block, patch, 1u);
  float4 high = fetch4(t.block, patch, 2u) + g * fetch4(t.block, patch, 3u);
  return low + (g * g) * high;
}

/// Two cubics, a at f0 in lane 0 and b at f2 in lane 2.
VNDF_FUNCTION float4 vndf_values(float4 a, float4 b, float4 f) {
  float4 even = low_halves(a, b) + f * high_halves(a, b);
  return even + (f * f) * odd_lanes(even);
}

/// One cubic.
VNDF_FUNCTION float vndf_value(float4 a, float f) {
  return vndf_values(a, a, make4(f, f, f, f))[0];
}

/// The derivative of a cubic at f.
VNDF_FUNCTION float vndf_rate(float4 a, float f) {
  return a[2] + f * (2.0f * a[1] + f * (3.0f * a[3]));
}

// 1. stretch

/// (x, y, z) of a direction next to the pole, scaled such that its digits are kept and h is 1: only
/// the zero vector has no azimuth, and 0 stands for it. Of an input outside its range the last
/// component is no number, and with it as its alpha all samples are (0, 0, 1).
VNDF_COLD_FUNCTION float4 vndf_stretched_unusual(float x, float y, float z, float alpha) {
  float size = larger(larger(x, -x), larger(y, -y));
  bool valid = z >= 0.0f && alpha > 0.0f && x - x == 0.0f && y - y == 0.0f;
  float a = size > 0.0f ? x / size : 1.0f;
  float b = size > 0.0f ? y / size : 0.0f;
  float h = square_root(a * a + b * b);
  float most = 1e9f;
  if (!valid) return make4(1.0f, 0.0f, 0.0f, float_of(0x7fc00000u));
  float cotangent = size > 0.0f ? smaller(z / (size * h), most) : most;
  return make4(a / h, b / h, cotangent, alpha);
}

VNDF_FUNCTION VndfDirection vndf_at(VNDF_IN(VndfTables) t, vec3 wi, float alpha_x, float alpha_y) {
  VndfDirection d;
  d.alpha_x = alpha_x;
  d.alpha_y = alpha_y;
  d.x = alpha_x * wi.x;
  d.y = alpha_y * wi.y;
  d.z = wi.z;
  d.h2 = d.x * d.x + d.y * d.y;
  float alpha = smaller(alpha_x, alpha_y);
  bool usual = vndf_within(d.h2, kVndfShortest, kVndfLongest) && d.z >= 0.0f && alpha > 0.0f;
  if VNDF_RARELY (!usual) {
    float4 scaled = vndf_stretched_unusual(d.x, d.y, d.z, alpha);
    d.x = scaled[0];
    d.y = scaled[1];
    d.z = scaled[2];
    d.h2 = 1.0f;
    d.alpha_x = scaled[3] == alpha ? alpha_x : scaled[3];
  }
  d.hu = square_root(d.h2) * t.unit;
  float g = d.hu / (d.hu + d.z);
  VndfCell row = vndf_cell(t, t.direction_guide, t.direction_shift, g + t.direction_offset);
  d.g = row.f;
  d.row = row.offset;
  return d;
}

// 2. sample the slope of the stretched configuration

VNDF_FUNCTION float vndf_between(VNDF_IN(VndfTables) t, float root) {
  return smaller(larger(root, t.least_root), t.most_root);
}

/// The place of s on the axis of slopes.
VNDF_FUNCTION float vndf_slope_place(VNDF_IN(VndfTables) t, float s) {
  float w = t.slope_middle - s;
  float p = smaller(magnitude(w) + t.slope_offset, t.slope_most);
  return float_of(bits_of(p) + ((0u - (bits_of(w) >> 31)) & t.slope_upper));
}

/// p with the sign of q.
VNDF_FUNCTION float4 vndf_root_columns(VNDF_IN(VndfTables) t, float4 q) {
  uint4 signs = bits_of(q) & make_uint4(kVndfSign, kVndfSign, kVndfSign, kVndfSign);
  float4 roots = square_root(floats_of(bits_of(q + q) ^ signs));
  float4 offset = make4(t.column_offset, t.column_offset, t.column_offset, t.column_offset);
  return floats_of(bits_of(roots + offset) ^ signs);
}

/// The places of u2 mirrored beyond the middle; those of u1 are left as they are.
VNDF_FUNCTION uint4 vndf_mirrored(VNDF_IN(VndfTables) t, float4 places) {
  float4 span = make4(kVndfLargest, kVndfLargest, t.column_span, t.column_span);
  float4 mirror = span - places;
  uint4 added = make_uint4(0u, 0u, t.column_mirror, t.column_mirror);
  return bits_of(smaller(places, mirror)) + (sign_mask(mirror - places) & added);
}

VNDF_FUNCTION bool vndf_separable(VNDF_IN(VndfTables) t, uint kind) {
  return kind == kVndfPlain || (kind == kVndfAny && t.separable != 0u);
}

VNDF_FUNCTION VndfDraw vndf_draw_as(VNDF_IN(VndfTables) t, VNDF_IN(VndfDirection) d, float u1,
                                    float u2, uint kind) {
  VndfDraw draw;
  // Adding and taking away 1.5 x 2^23 rounds to a whole number: q = u below one half, u - 1 above.
  float4 whole = make4(12582912.0f, 12582912.0f, 12582912.0f, 12582912.0f);
  float4 least = make4(kVndfLeastU, kVndfLeastU, kVndfLeastU, kVndfLeastU);
  float4 most = make4(kVndfMostU, kVndfMostU, kVndfMostU, kVndfMostU);
  float4 u = smaller(larger(make4(u1, u1, u2, u2), least), most);
  float4 q = u - ((u + whole) - whole);
  draw.upper = sign_mask(q);
  if (kind == kVndfAny && t.column_roots != 0u) q = vndf_root_columns(t, q);
  uint4 halves = make_uint4(t.column_upper, t.column_upper, kVndfSign, kVndfSign);
  uint4 places = bits_of(q) + (draw.upper & halves);
  if (!vndf_separable(t, kind)) places = vndf_mirrored(t, floats_of(places));
  draw.places = floats_of(places);
  uint4 keys = places >> t.column_shift;
  Guide column1 = fetch_guide(t.block, t.marginal_guide + (keys[0] << 3));
  Guide column2 = fetch_guide(t.block, t.conditional_guide + (keys[2] << 3));
  draw.f = draw.places - make4(column1.start, column1.start, column2.start, column2.start);
  draw.marginal = vndf_blend(t, column1.offset + d.row, d.g);
  float4 values;
  if (vndf_separable(t, kind)) {
    draw.conditional = fetch4(t.block, column2.offset, 0u);
    values = vndf_values(draw.marginal, draw.conditional, draw.f);
    draw.root = vndf_between(t, values[0]);
  } else {
    draw.s = vndf_values(draw.marginal, draw.marginal, draw.f)[0];
    float place = vndf_slope_place(t, draw.s);
    uint entry = t.slope_guide + ((bits_of(place) >> t.slope_shift) << 4);
    Guide map = fetch_guide(t.block, entry), row = fetch_guide(t.block, entry + 8u);
    draw.map = fetch4(t.block, map.offset, 0u);
    draw.map_f = place - map.start;
    draw.root = vndf_between(t, vndf_value(draw.map, draw.map_f));
    draw.conditional = vndf_blend(t, column2.offset + row.offset, place - row.start);
    values = vndf_values(draw.marginal, draw.conditional, draw.f);
  }
  uint4 signs = draw.upper & make_uint4(0u, 0u, kVndfSign, kVndfSign);
  draw.v = floats_of(bits_of(values) ^ signs)[2];
  return draw;
}

/// The scale of slope y, times d.
VNDF_FUNCTION float vndf_scale_as(VNDF_IN(VndfTables) t, float sigma, float d, uint kind) {
  if (kind == kVndfAny && t.rim > 0.0f) {
    float m = sigma - 0.5f, edge = t.rim * d;
    return square_root(larger((edge - m) * (edge + m), 0.0f));
  }
  return t.scale_root * (0.5f - d) + t.scale_constant * d;
}

/// The same for any tables.
VNDF_FUNCTION VndfDraw vndf_draw(VNDF_IN(VndfTables) t, VNDF_IN(VndfDirection) d, float u1,
                                 float u2) {
  return vndf_draw_as(t, d, u1, u2, kVndfAny);
}
VNDF_FUNCTION float vndf_scale(VNDF_IN(VndfTables) t, float sigma, float d) {
  return vndf_scale_as(t, sigma, d, kVndfAny);
}

// 3. rotate, 4. unstretch, 5. compute the normal

/// The normal of a draw, of any length: its component along z is d h^2.
VNDF_FUNCTION vec3 vndf_unstretched(VNDF_IN(VndfTables) t, VNDF_IN(VndfDirection) w, float sigma,
                                    float v, uint kind) {
  float d = sigma * (1.0f - sigma);
  // Minus slope x, which is at most the cotangent z / h.
  float x = larger((0.5f - sigma) * w.hu, -(d * w.z));
  float y = vndf_scale_as(t, sigma, d, kind) * v * w.hu;
  return make3(w.alpha_x * (w.x * x + w.y * y), w.alpha_y * (w.y * x - w.x * y), d * w.h2);
}

VNDF_FUNCTION vec3 vndf_unit_or_up(vec3 m) {
  float square = m.x * m.x + m.y * m.y + m.z * m.z;
  float scale = 1.0f / square_root(square);
  if VNDF_RARELY (!vndf_within(square, kVndfLeast, kVndfLargest)) return make3(0.0f, 0.0f, 1.0f);
  return make3(m.x * scale, m.y * scale, m.z * scale);
}

VNDF_FUNCTION vec3 vndf_sample_as(VNDF_IN(VndfTables) t, VNDF_IN(VndfDirection) w, float u1,
                                  float u2, uint kind) {
  VndfDraw draw = vndf_draw_as(t, w, u1, u2, kind);
  return vndf_unit_or_up(vndf_unstretched(t, w, draw.root * draw.root, draw.v, kind));
}

// Only the plain sampler is put in place: beside the other it would run short of registers.

VNDF_APART_FUNCTION vec3 vndf_sample_any(VNDF_IN(VndfTables) t, VNDF_IN(VndfDirection) w, float u1,
                                         float u2) {
  return vndf_sample_as(t, w, u1, u2, kVndfAny);
}

/// A normal for a direction that is prepared.
VNDF_FUNCTION vec3 vndf_sample(VNDF_IN(VndfTables) t, VNDF_IN(VndfDirection) w, float u1,
                               float u2) {
  if (t.kind == kVndfPlain) return vndf_sample_as(t, w, u1, u2, kVndfPlain);
  return vndf_sample_any(t, w, u1, u2);
}

VNDF_APART_FUNCTION vec3 vndf_sample_towards_any(VNDF_IN(VndfTables) t, VNDF_IN(vec3) wi,
                                                 float alpha_x, float alpha_y, float u1, float u2) {
  return vndf_sample_as(t, vndf_at(t, wi, alpha_x, alpha_y), u1, u2, kVndfAny);
}

/// A normal for a direction that is not.
VNDF_FUNCTION vec3 vndf_sample_towards(VNDF_IN(VndfTables) t, VNDF_IN(vec3) wi, float alpha_x,
                                       float alpha_y, float u1, float u2) {
  if (t.kind == kVndfPlain)
    return vndf_sample_as(t, vndf_at(t, wi, alpha_x, alpha_y), u1, u2, kVndfPlain);
  return vndf_sample_towards_any(t, wi, alpha_x, alpha_y, u1, u2);
}

// The density of the map: the reciprocal of its Jacobian. Slope x depends on u1 alone, so that the
// density of slopes is 1 / (dx/du1 dy/du2), and the normal's d h^2 takes all powers of d away.

/// dp / dq of the column axis.
VNDF_FUNCTION float vndf_column_rate(VNDF_IN(VndfTables) t, float p) {
  return t.column_roots != 0u ? 1.0f / (p - t.column_offset) : 1.0f;
}

/// |d place / dq| of u2.
VNDF_FUNCTION float vndf_second_rate(VNDF_IN(VndfTables) t, float place) {
  float far = float_of(0x3f800000u + t.column_mirror);
  bool mirrored = t.separable == 0u && place > 0.5f * t.column_span;
  if (!mirrored) return vndf_column_rate(t, place);
  return far * vndf_column_rate(t, t.column_span - place / far);
}

/// Of the normal `m` of the draw, before it is made a unit vector.
VNDF_FUNCTION float vndf_draw_density(VNDF_IN(VndfTables) t, VNDF_IN(VndfDirection) w,
                                      VNDF_IN(VndfDraw) draw, vec3 m) {
  float sigma = draw.root * draw.root, d = sigma * (1.0f - sigma);
  bool hidden = (0.5f - sigma) * w.hu < -(d * w.z);  // x is c for more than one u1
  bool clamped = draw.root == t.least_root || draw.root == t.most_root;
  // The power of two by which the places of u1 above one half are larger.
  float apart = draw.upper[0] != 0u ? float_of(0x3f800000u + (t.column_upper - kVndfSign)) : 1.0f;
  float droot = magnitude(vndf_rate(draw.marginal, draw.f[0])) * apart *
                vndf_column_rate(t, draw.places[0] / apart);
  if (t.separable == 0u) {
    float far = draw.s > t.slope_middle ? float_of(0x3f800000u + t.slope_upper) : 1.0f;
    droot = droot * magnitude(vndf_rate(draw.map, draw.map_f)) * far;
  }
  float dsigma = 2.0f * draw.root * droot;
  float dv =
      magnitude(vndf_rate(draw.conditional, draw.f[2])) * vndf_second_rate(t, draw.places[2]);
  float ratio = square_root(m.x * m.x + m.y * m.y + m.z * m.z) / w.h2;
  float stretch = t.unit * t.unit * w.alpha_x * w.alpha_y;
  float jacobian = stretch * (0.5f - d) * vndf_scale(t, sigma, d) * dsigma * dv;
  float density = ratio * ratio * ratio / jacobian;
  return !hidden && !clamped && density <= kVndfLargest ? density : kVndfLargest;
}

/// A unit normal and the density that it was drawn with; 0 for an input outside its range.
struct VndfSampledNormal {
  vec3 wm;
  float pdf;
};

VNDF_FUNCTION VndfSampledNormal vndf_sample_with_density(VNDF_IN(VndfTables) t,
                                                         VNDF_IN(VndfDirection) w, float u1,
                                                         float u2) {
  VndfDraw draw = vndf_draw(t, w, u1, u2);
  vec3 m = vndf_unstretched(t, w, draw.root * draw.root, draw.v, kVndfAny);
  VndfSampledNormal sampled;
  sampled.wm = vndf_unit_or_up(m);
  sampled.pdf = w.alpha_x == w.alpha_x ? vndf_draw_density(t, w, draw, m) : 0.0f;
  return sampled;
}

// The inverse of the map, by bisection of the bits of u.

struct VndfInverse {
  float u1, u2;
  bool found;
};

/// The distance on the sphere, along the axes, within which a normal beyond the first or the last
/// that the map gives counts as that one.
const float kVndfRangeSlack = 1.52587890625e-5f;  // 2^-16

/// Steps 4, 3 and 2 backwards: sigma of slope x and slope y over its scale.
VNDF_FUNCTION vec2 vndf_slope_of(VNDF_IN(VndfTables) t, VNDF_IN(VndfDirection) w, vec3 m) {
  float h = square_root(w.h2);
  float p = -m.x / w.alpha_x, q = -m.y / w.alpha_y;
  float x = (w.x * p + w.y * q) / h, y = (w.x * q - w.y * p) / h;
  // x over z U, as in bounded_cotangent() of table_coordinates.h.
  float z = m.z * t.unit, far = magnitude(x);
  float upper = far + square_root(far * far + z * z);
  float part = 1.0f / (upper + z);
  float d = (upper * part) * (z * part);
  float sigma = x < 0.0f ? z * part : upper * part;
  return make2(sigma, y * (part * upper * part) / vndf_scale(t, sigma, d));
}

/// The largest u1 in one half whose sigma is not above that asked for; or u2 with its y.
VNDF_FUNCTION float vndf_bisect(VNDF_IN(VndfTables) t, VNDF_IN(VndfDirection) w, float target,
                                float given_u1, bool second) {
  uint low = bits_of(kVndfLeastU), high = bits_of(kVndfMostU);
  for (uint step = 0u; step < 31u && low + 1u < high; ++step) {
    uint middle = low + ((high - low) >> 1);
    float u = float_of(middle);
    VndfDraw draw = vndf_draw(t, w, second ? given_u1 : u, second ? u : 0.5f);
    if ((second ? draw.v : draw.root * draw.root) <= target)
      low = middle;
    else
      high = middle;
  }
  return float_of(low);
}

/// Whether u is neither end of what vndf_bisect() looks at.
VNDF_FUNCTION bool vndf_inside(float u) {
  return u > kVndfLeastU && bits_of(u) + 1u < bits_of(kVndfMostU);
}

VNDF_FUNCTION VndfInverse vndf_invert(VNDF_IN(VndfTables) t, VNDF_IN(VndfDirection) w, vec3 m) {
  vec2 slope = vndf_slope_of(t, w, m);
  VndfInverse inverse;
  inverse.u1 = vndf_bisect(t, w, slope.x, 0.5f, false);
  inverse.u2 = vndf_bisect(t, w, slope.y, inverse.u1, true);
  // What lies between the ends is between two neighbours of u.
  bool inside = vndf_inside(inverse.u1) && vndf_inside(inverse.u2);
  vec3 n = vndf_sample(t, w, inverse.u1, inverse.u2);
  float distance = magnitude(m.x - n.x) + magnitude(m.y - n.y) + magnitude(m.z - n.z);
  inverse.found = inside || distance <= kVndfRangeSlack;
  return inverse;
}

// D, Lambda, G1 and the density of the exact law

/// A positive curve, of which the tables keep the logarithm to base 2 in segments; 0 between and
/// beyond them.
VNDF_FUNCTION float vndf_curve(VNDF_IN(VndfTables) t, VndfCurve curve, float place) {
  float x = smaller(place, kVndfFarthest);
  for (uint k = 0u; k < curve.count; ++k) {
    uint at = curve.segments + (k << 5);
    Guide begin = fetch_guide(t.block, at), end = fetch_guide(t.block, at + 8u);
    if (x < begin.start) return 0.0f;
    if (x <= end.start) {
      float offset = fetch_guide(t.block, at + 16u).start;
      VndfCell cell = vndf_cell(t, begin.offset, end.offset, (x - begin.start) + offset);
      float4 cubic = fetch4(t.block, cell.offset, 0u);
      // The square of a far place would overflow.
      float rest = cubic[2] + cell.f * (cubic[1] + cell.f * cubic[3]);
      return power_of_two(cubic[0] + cell.f * rest);
    }
  }
  return 0.0f;
}

VNDF_FUNCTION bool vndf_valid(vec3 w, float alpha_x, float alpha_y) {
  float sum = magnitude(w.x) + magnitude(w.y) + alpha_x + alpha_y;
  return w.z >= 0.0f && smaller(alpha_x, alpha_y) > 0.0f && sum <= kVndfLargest;
}

/// D(wm) per solid angle; 0 for a horizontal or back-facing normal.
VNDF_FUNCTION float vndf_d(VNDF_IN(VndfTables) t, vec3 wm, float alpha_x, float alpha_y) {
  if (!vndf_valid(wm, alpha_x, alpha_y) || !(wm.z > 0.0f)) return 0.0f;
  float ax = alpha_x * t.unit, ay = alpha_y * t.unit;
  float x = wm.x / ax, y = wm.y / ay;
  float h2 = x * x + y * y, square = h2 + wm.z * wm.z;
  return vndf_curve(t, t.ndf, square_root(h2) / wm.z) / (ax * ay * square * square);
}

/// w.z Lambda(w): the projected area of the facets that face away from w.
VNDF_FUNCTION float vndf_backfacing_area(VNDF_IN(VndfTables) t, vec3 w, float alpha_x,
                                         float alpha_y) {
  float x = alpha_x * t.unit * w.x, y = alpha_y * t.unit * w.y;
  float h = square_root(x * x + y * y);
  return h > 0.0f ? h * vndf_curve(t, t.backfacing, w.z / h) : 0.0f;
}

/// Lambda of a direction or its mirror below the horizon; infinite at the horizon.
VNDF_FUNCTION float vndf_lambda(VNDF_IN(VndfTables) t, vec3 w, float alpha_x, float alpha_y) {
  vec3 above = make3(w.x, w.y, magnitude(w.z));
  if (!vndf_valid(above, alpha_x, alpha_y)) return 0.0f;
  return vndf_backfacing_area(t, above, alpha_x, alpha_y) / above.z;
}

VNDF_FUNCTION float vndf_g1(VNDF_IN(VndfTables) t, vec3 w, float alpha_x, float alpha_y) {
  vec3 above = make3(w.x, w.y, magnitude(w.z));
  if (!vndf_valid(above, alpha_x, alpha_y) || above.z == 0.0f) return 0.0f;
  return above.z / (above.z + vndf_backfacing_area(t, above, alpha_x, alpha_y));
}

/// D_wi(wm) = dot(wi, wm)+ D(wm) / (wi.z (1 + Lambda(wi))) (equation 2).
VNDF_FUNCTION float vndf_pdf(VNDF_IN(VndfTables) t, vec3 wi, vec3 wm, float alpha_x,
                             float alpha_y) {
  float cosine = wi.x * wm.x + wi.y * wm.y + wi.z * wm.z;
  if (!vndf_valid(wi, alpha_x, alpha_y) || !(cosine > 0.0f)) return 0.0f;
  float area = wi.z + vndf_backfacing_area(t, wi, alpha_x, alpha_y);
  return cosine * vndf_d(t, wm, alpha_x, alpha_y) / area;
}
