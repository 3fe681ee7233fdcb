// Part 2 of kernel_text.h: Algorithm 4 of Heitz and d'Eon 2014, step by step.

// 1. stretch

/// The stretched direction (x, y, z) next to a pole, scaled so that its digits are kept and h is 1,
/// and `alpha`. Only a vector without horizontal part has no azimuth, and 0 stands for it. Straight
/// from below infinite slopes are visible, and those from a cotangent of -1e18 stand for them. For
/// an input outside its range the last component is not a number; with that as alpha all samples
/// are (0, 0, 1). It stands apart because it is seldom needed.
VNDF_COLD_FUNCTION float4 vndf_stretched_unusual(float x, float y, float z, float alpha) {
  float size = larger(larger(x, -x), larger(y, -y));
  bool valid = z == z && alpha > 0.0f && x - x == 0.0f && y - y == 0.0f;
  float a = size > 0.0f ? x / size : 1.0f;
  float b = size > 0.0f ? y / size : 0.0f;
  float h = square_root(a * a + b * b);
  float lowest = -1e18f, most = 1e9f;
  if (!valid) return make4(1.0f, 0.0f, 0.0f, float_of(0x7fc00000u));
  float pole = z < 0.0f ? lowest : most;
  float cotangent = size > 0.0f ? larger(smaller(z / (size * h), most), lowest) : pole;
  return make4(a / h, b / h, cotangent, alpha);
}

/// `wi` stretched by alpha, without a row.
VNDF_FUNCTION VndfDirection vndf_stretched(VNDF_IN(VndfTables) t, vec3 wi, float alpha_x,
                                           float alpha_y) {
  VndfDirection d;
  d.alpha_x = alpha_x;
  d.alpha_y = alpha_y;
  d.x = alpha_x * wi.x;
  d.y = alpha_y * wi.y;
  d.z = wi.z;
  d.h2 = d.x * d.x + d.y * d.y;
  float alpha = smaller(alpha_x, alpha_y);
  bool usual = vndf_within(d.h2, kVndfShortest, kVndfLongest) && alpha > 0.0f;
  if VNDF_RARELY (!usual) {
    float4 scaled = vndf_stretched_unusual(d.x, d.y, d.z, alpha);
    d.x = scaled[0];
    d.y = scaled[1];
    d.z = scaled[2];
    d.h2 = 1.0f;
    d.alpha_x = scaled[3] == alpha ? alpha_x : scaled[3];
  }
  d.hu = square_root(d.h2) * t.unit;
  d.kind = t.kind;
  d.edge = 1.0f;
  return d;
}

/// The row of patches of a stretched direction from above or from the horizon.
VNDF_FUNCTION VndfCell vndf_row(VNDF_IN(VndfTables) t, VNDF_IN(VndfDirection) d) {
  float g = d.hu / (d.hu + d.z);
  return vndf_cell(t, t.direction_guide, t.direction_shift, g + t.direction_offset);
}

/// The row of patches of a stretched direction from below the horizon, given its g.
VNDF_FUNCTION VndfCell vndf_row_below(VNDF_IN(VndfTables) t, float g) {
  float place = larger(g + t.direction_offset, t.below.least_place);
  return vndf_cell(t, t.below.direction_guide, t.below.direction_shift, place);
}

/// Step 1: the direction `wi` stretched by alpha, and its row of patches. Below the horizon, where
/// nothing is visible and if z is not a number, all samples are (0, 0, 1).
VNDF_FUNCTION VndfDirection vndf_at(VNDF_IN(VndfTables) t, vec3 wi, float alpha_x, float alpha_y) {
  VndfDirection d = vndf_stretched(t, wi, alpha_x, alpha_y);
  VndfCell row;
  if (d.z >= 0.0f) {
    row = vndf_row(t, d);
  } else if (-d.z < t.below.most_cotangent * d.hu) {
    float g = d.hu / (d.hu - d.z);
    row = vndf_row_below(t, g);
    d.kind = kVndfBelow;
    d.edge = square_root(g);
  } else {
    d.alpha_x = float_of(0x7fc00000u);
    d.z = 0.0f;
    row = vndf_row(t, d);
  }
  d.g = row.f;
  d.row = row.offset;
  return d;
}

// 2. sample the slope of the stretched configuration

/// The root of sigma within its bounds.
VNDF_FUNCTION float vndf_between(VNDF_IN(VndfTables) t, float root) {
  return smaller(larger(root, t.least_root), t.most_root);
}

/// The place of s on the axis of slope x.
VNDF_FUNCTION float vndf_slope_place(VNDF_IN(VndfTables) t, float s) {
  float w = t.slope_middle - s;
  float p = smaller(magnitude(w) + t.slope_offset, t.slope_most);
  return float_of(bits_of(p) + ((0u - (bits_of(w) >> 31)) & t.slope_upper));
}

/// sqrt(2 |q|) + the offset of columns, with the sign of q.
VNDF_FUNCTION float4 vndf_root_columns(VNDF_IN(VndfTables) t, float4 q) {
  uint4 signs = bits_of(q) & make_uint4(kVndfSign, kVndfSign, kVndfSign, kVndfSign);
  float4 roots = square_root(floats_of(bits_of(q + q) ^ signs));
  float4 offset = make4(t.column_offset, t.column_offset, t.column_offset, t.column_offset);
  return floats_of(bits_of(roots + offset) ^ signs);
}

/// The bits of the places, of which those of u2 are mirrored beyond the middle of their axis.
VNDF_FUNCTION uint4 vndf_mirrored(VNDF_IN(VndfTables) t, float4 places) {
  float4 span = make4(kVndfLargest, kVndfLargest, t.column_span, t.column_span);
  float4 mirror = span - places;
  uint4 added = make_uint4(0u, 0u, t.column_mirror, t.column_mirror);
  return bits_of(smaller(places, mirror)) + (sign_mask(mirror - places) & added);
}

VNDF_FUNCTION bool vndf_separable(VNDF_IN(VndfTables) t, uint kind) {
  return kind == kVndfPlain || (kind == kVndfAny && t.separable != 0u);
}

/// Up to the columns of both u, which are worked on side by side, in two lanes each: the cubic of
/// u1, and where the coefficients of u2 begin.
VNDF_FUNCTION VndfDraw vndf_draw_columns(VNDF_IN(VndfTables) t, VNDF_IN(VndfDirection) d,
                                         uint guide1, uint guide2, float u1, float u2, uint kind) {
  VndfDraw draw;
  float4 least = make4(kVndfLeastU, kVndfLeastU, kVndfLeastU, kVndfLeastU);
  float4 most = make4(kVndfMostU, kVndfMostU, kVndfMostU, kVndfMostU);
  float4 u = smaller(larger(make4(u1, u1, u2, u2), least), most);
  float4 q = u - nearest_whole(u);  // u below one half, u - 1 above
  draw.upper = sign_mask(q);
  if (kind == kVndfAny && t.column_roots != 0u) q = vndf_root_columns(t, q);
  uint4 halves = make_uint4(t.column_upper, t.column_upper, kVndfSign, kVndfSign);
  uint4 places = bits_of(q) + (draw.upper & halves);
  if (!vndf_separable(t, kind)) places = vndf_mirrored(t, floats_of(places));
  draw.places = floats_of(places);
  uint4 keys = places >> t.column_shift;
  Guide column1 = fetch_guide(t.block, guide1 + (keys[0] << 3));
  Guide column2 = fetch_guide(t.block, guide2 + (keys[2] << 3));
  draw.f = draw.places - make4(column1.start, column1.start, column2.start, column2.start);
  draw.marginal = vndf_blend(t, column1.offset + d.row, d.g);
  draw.second = column2.offset;
  return draw;
}

/// Slope y over its scale, with its sign, of the values of the cubics.
VNDF_FUNCTION float vndf_signed_y(VNDF_IN(VndfDraw) draw, float4 values) {
  uint4 signs = draw.upper & make_uint4(0u, 0u, kVndfSign, kVndfSign);
  return floats_of(bits_of(values) ^ signs)[2];
}

/// Step 2 for one kind of tables: 2.a slope x for u1, 2.b slope y for u2 given slope x.
VNDF_FUNCTION VndfDraw vndf_draw_as(VNDF_IN(VndfTables) t, VNDF_IN(VndfDirection) d, float u1,
                                    float u2, uint kind) {
  VndfDraw draw = vndf_draw_columns(t, d, t.marginal_guide, t.conditional_guide, u1, u2, kind);
  float4 values;
  if (vndf_separable(t, kind)) {
    draw.conditional = fetch4(t.block, draw.second, 0u);
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
    draw.conditional = vndf_blend(t, draw.second + row.offset, place - row.start);
    values = vndf_values(draw.marginal, draw.conditional, draw.f);
  }
  draw.v = vndf_signed_y(draw, values);
  return draw;
}

/// Step 2 from below the horizon. Only steep slopes are visible, so patches hold the root of sigma
/// over about that of the cotangent, whatever the tables, and the axis of rows of y is by the root.
VNDF_FUNCTION VndfDraw vndf_draw_below(VNDF_IN(VndfTables) t, VNDF_IN(VndfDirection) d, float u1,
                                       float u2) {
  VndfDraw draw =
      vndf_draw_columns(t, d, t.below.marginal_guide, t.below.conditional_guide, u1, u2, kVndfAny);
  draw.root = vndf_between(t, d.edge * vndf_value(draw.marginal, draw.f[0]));
  if (t.separable != 0u) {
    draw.conditional = fetch4(t.block, draw.second, 0u);
  } else {
    float place = larger(kVndfMiddleRoot - draw.root, 0.0f) + t.slope_offset;
    VndfCell row =
        vndf_cell(t, t.below.slope_guide, t.below.slope_shift, smaller(place, t.below.slope_most));
    draw.conditional = vndf_blend(t, draw.second + row.offset, row.f);
  }
  draw.v = vndf_signed_y(draw, vndf_values(draw.marginal, draw.conditional, draw.f));
  return draw;
}

/// The scale of slope y at `sigma`, times d, for one kind of tables.
VNDF_FUNCTION float vndf_scale_as(VNDF_IN(VndfTables) t, float sigma, float d, uint kind) {
  if (kind == kVndfAny && t.rim > 0.0f) {
    float m = sigma - 0.5f, edge = t.rim * d;
    return square_root(larger((edge - m) * (edge + m), 0.0f));
  }
  return t.scale_root * (0.5f - d) + t.scale_constant * d;
}

/// Step 2, and the scale of slope y, for any tables.
VNDF_FUNCTION VndfDraw vndf_draw(VNDF_IN(VndfTables) t, VNDF_IN(VndfDirection) d, float u1,
                                 float u2) {
  if (d.kind == kVndfBelow) return vndf_draw_below(t, d, u1, u2);
  return vndf_draw_as(t, d, u1, u2, kVndfAny);
}
VNDF_FUNCTION float vndf_scale(VNDF_IN(VndfTables) t, float sigma, float d) {
  return vndf_scale_as(t, sigma, d, kVndfAny);
}

// 3. rotate, 4. unstretch, 5. compute the normal

/// Steps 3 and 4: the normal of the slope, of any length. It is multiplied by d h^2, by which all
/// divisions of the slope are avoided.
VNDF_FUNCTION vec3 vndf_unstretched(VNDF_IN(VndfTables) t, VNDF_IN(VndfDirection) w, float sigma,
                                    float v, uint kind) {
  float d = sigma * (1.0f - sigma);
  // Minus slope x, times d h U. Slope x is at most the cotangent z / h, beyond which no facet is
  // seen.
  float x = larger((0.5f - sigma) * w.hu, -(d * w.z));
  float y = vndf_scale_as(t, sigma, d, kind) * v * w.hu;
  return make3(w.alpha_x * (w.x * x + w.y * y), w.alpha_y * (w.y * x - w.x * y), d * w.h2);
}

/// Step 5: the unit normal; (0, 0, 1) for a vector that has none.
VNDF_FUNCTION vec3 vndf_unit_or_up(vec3 m) {
  float square = m.x * m.x + m.y * m.y + m.z * m.z;
  float scale = 1.0f / square_root(square);
  if VNDF_RARELY (!vndf_within(square, kVndfLeast, kVndfLargest)) return make3(0.0f, 0.0f, 1.0f);
  return make3(m.x * scale, m.y * scale, m.z * scale);
}

/// Steps 2 to 4 for plain tables: a normal of any length.
VNDF_FUNCTION vec3 vndf_drawn_plain(VNDF_IN(VndfTables) t, VNDF_IN(VndfDirection) w, float u1,
                                    float u2) {
  VndfDraw draw = vndf_draw_as(t, w, u1, u2, kVndfPlain);
  return vndf_unstretched(t, w, draw.root * draw.root, draw.v, kVndfPlain);
}

/// Steps 2 to 4 for any tables.
VNDF_FUNCTION vec3 vndf_drawn_any(VNDF_IN(VndfTables) t, VNDF_IN(VndfDirection) w, float u1,
                                  float u2) {
  VndfDraw draw = vndf_draw(t, w, u1, u2);
  return vndf_unstretched(t, w, draw.root * draw.root, draw.v, kVndfAny);
}

// Only the sampler of plain tables is put in place. Beside it the other one would take registers
// from it, and is a function that is called.

VNDF_APART_FUNCTION vec3 vndf_drawn_apart(VNDF_IN(VndfTables) t, VNDF_IN(VndfDirection) w, float u1,
                                          float u2) {
  return vndf_drawn_any(t, w, u1, u2);
}

/// Steps 2 to 4: a normal of any length, for a direction that is stretched already.
VNDF_FUNCTION vec3 vndf_drawn(VNDF_IN(VndfTables) t, VNDF_IN(VndfDirection) w, float u1, float u2) {
  if (w.kind == kVndfPlain) return vndf_drawn_plain(t, w, u1, u2);
  return vndf_drawn_apart(t, w, u1, u2);
}

/// Steps 2 to 5: a normal for a direction that is stretched already.
VNDF_FUNCTION vec3 vndf_sample(VNDF_IN(VndfTables) t, VNDF_IN(VndfDirection) w, float u1,
                               float u2) {
  return vndf_unit_or_up(vndf_drawn(t, w, u1, u2));
}

VNDF_APART_FUNCTION vec3 vndf_drawn_towards_apart(VNDF_IN(VndfTables) t, VNDF_IN(vec3) wi,
                                                  float alpha_x, float alpha_y, float u1,
                                                  float u2) {
  return vndf_drawn_any(t, vndf_at(t, wi, alpha_x, alpha_y), u1, u2);
}

/// Steps 1 to 4: a normal of any length, seen from `wi` of any length.
VNDF_FUNCTION vec3 vndf_drawn_towards(VNDF_IN(VndfTables) t, VNDF_IN(vec3) wi, float alpha_x,
                                      float alpha_y, float u1, float u2) {
  if (t.kind == kVndfPlain && wi.z >= 0.0f) {
    VndfDirection above = vndf_stretched(t, wi, alpha_x, alpha_y);
    VndfCell row = vndf_row(t, above);
    above.g = row.f;
    above.row = row.offset;
    return vndf_drawn_plain(t, above, u1, u2);
  }
  return vndf_drawn_towards_apart(t, wi, alpha_x, alpha_y, u1, u2);
}

/// Steps 1 to 5: a normal seen from `wi`.
VNDF_FUNCTION vec3 vndf_sample_towards(VNDF_IN(VndfTables) t, VNDF_IN(vec3) wi, float alpha_x,
                                       float alpha_y, float u1, float u2) {
  return vndf_unit_or_up(vndf_drawn_towards(t, wi, alpha_x, alpha_y, u1, u2));
}
