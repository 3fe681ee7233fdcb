// Part 3 of kernel_text.h: the map from random numbers to normals as a change of variables, with
// its density, the reciprocal of its Jacobian, and its inverse.

/// dp / dq at a place p of the axis of columns.
VNDF_FUNCTION float vndf_column_rate(VNDF_IN(VndfTables) t, float p) {
  return t.column_roots != 0u ? 1.0f / (p - t.column_offset) : 1.0f;
}

/// |d place / dq| at a place of u2, which may be mirrored.
VNDF_FUNCTION float vndf_second_rate(VNDF_IN(VndfTables) t, float place) {
  float apart = float_of(0x3f800000u + t.column_mirror);
  bool mirrored = t.separable == 0u && place > 0.5f * t.column_span;
  if (!mirrored) return vndf_column_rate(t, place);
  return apart * vndf_column_rate(t, t.column_span - place / apart);
}

/// The density per solid angle of the normal of a draw, `m` before step 5. Slope x depends on u1
/// alone, so that the Jacobian of the map is triangular and the density of slopes is 1 / (dx/du1
/// dy/du2). dm = m.z^3 alpha_x alpha_y dx dy for a unit normal, and because m is multiplied by d
/// h^2 all powers of d, which vanish at infinite slopes, cancel.
VNDF_FUNCTION float vndf_draw_density(VNDF_IN(VndfTables) t, VNDF_IN(VndfDirection) w,
                                      VNDF_IN(VndfDraw) draw, vec3 m) {
  float sigma = draw.root * draw.root, d = sigma * (1.0f - sigma);
  bool hidden = (0.5f - sigma) * w.hu < -(d * w.z);  // then slope x is c, for many u1
  bool clamped = draw.root == t.least_root || draw.root == t.most_root;
  // By which power of two the places of u1 are larger.
  float apart = draw.upper[0] != 0u ? float_of(0x3f800000u + (t.column_upper - kVndfSign)) : 1.0f;
  float droot = magnitude(vndf_rate(draw.marginal, draw.f[0])) * apart *
                vndf_column_rate(t, draw.places[0] / apart);
  if (w.kind == kVndfBelow) {
    droot = droot * w.edge;
  } else if (t.separable == 0u) {
    float upper = draw.s > t.slope_middle ? float_of(0x3f800000u + t.slope_upper) : 1.0f;
    droot = droot * magnitude(vndf_rate(draw.map, draw.map_f)) * upper;
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

/// A unit normal and the density per solid angle with which it was drawn.
struct VndfSampledNormal {
  vec3 wm;
  float pdf;
};

/// The normal of vndf_sample() and its density: 0 for an input outside its range, the largest
/// number where many u give the same normal.
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

/// The random numbers of a normal, if there are any.
struct VndfInverse {
  float u1, u2;
  bool found;
};

/// How far from the first or the last normal that the map gives another one may be, summed over the
/// axes, and still be taken for it.
VNDF_CONSTANT float kVndfRangeSlack = 1.52587890625e-5f;  // 2^-16

/// Inverse of steps 3 and 4: sigma of slope x, and slope y over its scale.
VNDF_FUNCTION vec2 vndf_slope_of(VNDF_IN(VndfTables) t, VNDF_IN(VndfDirection) w, vec3 m) {
  float h = square_root(w.h2);
  float p = -m.x / w.alpha_x, q = -m.y / w.alpha_y;
  float x = (w.x * p + w.y * q) / h, y = (w.x * q - w.y * p) / h;
  // x over z U, as in bounded_cotangent() of table_coordinates.h.
  float z = m.z * t.unit, steep = magnitude(x);
  float upper = steep + square_root(steep * steep + z * z);
  float part = 1.0f / (upper + z);
  float d = (upper * part) * (z * part);
  float sigma = x < 0.0f ? z * part : upper * part;
  return make2(sigma, y * (part * upper * part) / vndf_scale(t, sigma, d));
}

/// The largest u1 whose sigma is not above `target` or, if `second`, the largest u2 whose slope y
/// over its scale is not above it, given u1. Both increase with u, and the bits of u are bisected,
/// so that the result is exact whatever the cells are.
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

/// Whether u is neither end of the range that vndf_bisect() searches.
VNDF_FUNCTION bool vndf_inside(float u) {
  return u > kVndfLeastU && bits_of(u) + 1u < bits_of(kVndfMostU);
}

/// Inverse of vndf_sample().
VNDF_FUNCTION VndfInverse vndf_invert(VNDF_IN(VndfTables) t, VNDF_IN(VndfDirection) w, vec3 m) {
  vec2 slope = vndf_slope_of(t, w, m);
  VndfInverse inverse;
  inverse.u1 = vndf_bisect(t, w, slope.x, 0.5f, false);
  inverse.u2 = vndf_bisect(t, w, slope.y, inverse.u1, true);
  // Between the ends every normal lies between those of two neighbouring u.
  bool inside = vndf_inside(inverse.u1) && vndf_inside(inverse.u2);
  vec3 n = vndf_sample(t, w, inverse.u1, inverse.u2);
  float distance = magnitude(m.x - n.x) + magnitude(m.y - n.y) + magnitude(m.z - n.z);
  inverse.found = inside || distance <= kVndfRangeSlack;
  return inverse;
}
