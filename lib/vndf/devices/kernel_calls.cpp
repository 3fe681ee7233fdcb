// Calls the kernel, and the kernel once more in rough arithmetic.
#include "vndf/devices/kernel_calls.h"

#include <algorithm>
#include <cstring>

#include "vndf/devices/rough_arithmetic.h"

namespace vndf::devices::rough {

// The text of the kernel says float; here that is a number of the rough device.
#define float Number
#include "vndf/kernel_text.h"
#undef float

}  // namespace vndf::devices::rough

namespace vndf::devices {
namespace {

/// The same tables for the rough device, whose numbers are kept as floats are.
rough::VndfTables rough_tables(const kernel::VndfTables& tables) {
  rough::VndfTables same;
  static_assert(sizeof same == sizeof tables);
  std::memcpy(static_cast<void*>(&same), &tables, sizeof same);
  return same;
}

rough::vec3 rough_vector(const Vec3<float>& v) {
  return {v.x, v.y, v.z};
}

}  // namespace

KernelOutput call_kernel(const Kernel& kernel, const KernelInput& input) {
  const auto [wi, alpha, u1, u2] = input;
  const SampledNormal<float> sampled = kernel.sample_with_density(wi, alpha, u1, u2);
  const Vec3<float> wm = sampled.wm;
  const auto inverse = kernel.invert(wi, wm, alpha);
  const Vec2<float> u = inverse.value_or(Vec2<float>{0, 0});
  return {kernel.sample(wi, alpha, u1, u2),
          sampled.pdf,
          kernel.d(wm, alpha),
          kernel.pdf(wi, wm, alpha),
          kernel.lambda(wi, alpha),
          kernel.g1(wi, alpha),
          u.x,
          u.y,
          inverse ? 1.0f : 0.0f};
}

KernelOutput call_rough_kernel(const Kernel& kernel, const KernelInput& input,
                               const Vec3<float>& given, const RoughDevice& device) {
  rough::device = {device.seed, device.excess};
  const rough::VndfTables t = rough_tables(kernel.tables());
  const rough::vec3 wi = rough_vector(input.wi), wm = rough_vector(given);
  const rough::Number ax = input.alpha.x, ay = input.alpha.y, u1 = input.u1, u2 = input.u2;
  const rough::vec3 drawn = rough::vndf_sample_towards(t, wi, ax, ay, u1, u2);
  const rough::VndfDirection at = rough::vndf_at(t, wi, ax, ay);
  const bool valid = rough::vndf_valid(wi, ax, ay) && given.z > 0.0f;
  const rough::VndfInverse inverse = rough::vndf_invert(t, at, wm);
  const bool found = valid && inverse.found;
  return {{drawn.x.value(), drawn.y.value(), drawn.z.value()},
          rough::vndf_sample_with_density(t, at, u1, u2).pdf.value(),
          rough::vndf_d(t, wm, ax, ay).value(),
          rough::vndf_pdf(t, wi, wm, ax, ay).value(),
          rough::vndf_lambda(t, wi, ax, ay).value(),
          rough::vndf_g1(t, wi, ax, ay).value(),
          found ? inverse.u1.value() : 0.0f,
          found ? inverse.u2.value() : 0.0f,
          found ? 1.0f : 0.0f};
}

}  // namespace vndf::devices
