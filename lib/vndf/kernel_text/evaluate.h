// Part 4 of kernel_text.h: D, Lambda, G1 and the density of the exact distribution, from two
// curves.

/// A positive function of one slope at `place`. Tables keep its logarithm to base 2 in segments; it
/// is 0 between and beyond them.
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
      // By Horner's rule, for the square of a far place would overflow.
      float rest = cubic[2] + cell.f * (cubic[1] + cell.f * cubic[3]);
      return power_of_two(cubic[0] + cell.f * rest);
    }
  }
  return 0.0f;
}

/// Whether `w` is a direction, above the horizon or below it, and alpha a roughness.
VNDF_FUNCTION bool vndf_valid(vec3 w, float alpha_x, float alpha_y) {
  float sum = magnitude(w.x) + magnitude(w.y) + alpha_x + alpha_y;
  return w.z == w.z && smaller(alpha_x, alpha_y) > 0.0f && sum <= kVndfLargest;
}

/// The distribution of normals D(wm), per solid angle; 0 for a horizontal or back-facing normal.
VNDF_FUNCTION float vndf_d(VNDF_IN(VndfTables) t, vec3 wm, float alpha_x, float alpha_y) {
  if (!vndf_valid(wm, alpha_x, alpha_y) || !(wm.z > 0.0f)) return 0.0f;
  float ax = alpha_x * t.unit, ay = alpha_y * t.unit;
  float x = wm.x / ax, y = wm.y / ay;
  float h2 = x * x + y * y, square = h2 + wm.z * wm.z;
  return vndf_curve(t, t.ndf, square_root(h2) / wm.z) / (ax * ay * square * square);
}

/// |w.z| Lambda(w): the projected area of the facets that face away from w or, below the horizon,
/// of those that face it.
VNDF_FUNCTION float vndf_backfacing_area(VNDF_IN(VndfTables) t, vec3 w, float alpha_x,
                                         float alpha_y) {
  float x = alpha_x * t.unit * w.x, y = alpha_y * t.unit * w.y;
  float h = square_root(x * x + y * y);
  return h > 0.0f ? h * vndf_curve(t, t.backfacing, magnitude(w.z) / h) : 0.0f;
}

/// Projected area of the facets that face w, per area of the surface: w.z (1 + Lambda(w)) above the
/// horizon and |w.z| Lambda(w) below it.
VNDF_FUNCTION float vndf_visible_area(VNDF_IN(VndfTables) t, vec3 w, float alpha_x, float alpha_y) {
  if (!vndf_valid(w, alpha_x, alpha_y)) return 0.0f;
  return larger(w.z, 0.0f) + vndf_backfacing_area(t, w, alpha_x, alpha_y);
}

/// Smith's Lambda of a direction or of its mirror below the horizon; infinite at the horizon.
VNDF_FUNCTION float vndf_lambda(VNDF_IN(VndfTables) t, vec3 w, float alpha_x, float alpha_y) {
  if (!vndf_valid(w, alpha_x, alpha_y)) return 0.0f;
  return vndf_backfacing_area(t, w, alpha_x, alpha_y) / magnitude(w.z);
}

/// Smith's masking G1 = 1 / (1 + Lambda); 0 at the horizon.
VNDF_FUNCTION float vndf_g1(VNDF_IN(VndfTables) t, vec3 w, float alpha_x, float alpha_y) {
  float z = magnitude(w.z);
  if (!vndf_valid(w, alpha_x, alpha_y) || z == 0.0f) return 0.0f;
  return z / (z + vndf_backfacing_area(t, w, alpha_x, alpha_y));
}

/// The density of the exact distribution, D_wi(wm) = dot(wi, wm)+ D(wm) over the visible area of wi
/// (equation 2); 0 where nothing is visible.
VNDF_FUNCTION float vndf_pdf(VNDF_IN(VndfTables) t, vec3 wi, vec3 wm, float alpha_x,
                             float alpha_y) {
  float cosine = wi.x * wm.x + wi.y * wm.y + wi.z * wm.z;
  float area = vndf_visible_area(t, wi, alpha_x, alpha_y);
  if (!(cosine > 0.0f) || !(area > 0.0f)) return 0.0f;
  return smaller(cosine * vndf_d(t, wm, alpha_x, alpha_y) / area, kVndfLargest);
}
