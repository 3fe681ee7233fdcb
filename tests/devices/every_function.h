// Calls every function of an exported kernel as call_rough_kernel() of kernel_calls.h does. GLSL,
// HLSL and Metal share this text: who includes it has included the exported source, and says vec3
// and vec2 where the language has other words.

struct GoldenOutput {
  vec3 wm;
  float density, d, pdf, lambda, g1, u1, u2, found;
};

GoldenOutput every_function(VndfTables t, vec3 wi, vec2 alpha, vec2 u, vec3 given) {
  VndfDirection at = vndf_at(t, wi, alpha.x, alpha.y);
  GoldenOutput o;
  o.wm = vndf_sample_towards(t, wi, alpha.x, alpha.y, u.x, u.y);
  o.density = vndf_sample_with_density(t, at, u.x, u.y).pdf;
  o.d = vndf_d(t, given, alpha.x, alpha.y);
  o.pdf = vndf_pdf(t, wi, given, alpha.x, alpha.y);
  o.lambda = vndf_lambda(t, wi, alpha.x, alpha.y);
  o.g1 = vndf_g1(t, wi, alpha.x, alpha.y);
  VndfInverse inverse = vndf_invert(t, at, given);
  bool valid = vndf_valid(wi, alpha.x, alpha.y) && given.z > 0.0f;
  bool found = valid && inverse.found;
  o.u1 = found ? inverse.u1 : 0.0f;
  o.u2 = found ? inverse.u2 : 0.0f;
  o.found = found ? 1.0f : 0.0f;
  return o;
}
