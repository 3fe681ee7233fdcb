// Samples from a pair of tables that a file gave: what a reader accepts must work.
#pragma once

#include <cmath>
#include <memory>

#include "fuzz/fuzz_target.h"
#include "vndf/tabulated_sampler.h"

namespace vndf::fuzz {

/// Draws a few normals at the edges and in the middle of all inputs. Requires that they are unit
/// vectors above the horizon and that no density is negative.
template <class Sampler>
void use_sampler(const Sampler& sampler) {
  const Alpha<float> alpha{0.5f, 0.2f};
  for (const float z : {-1.0f, -0.5f, -1e-3f, 0.0f, 1e-3f, 0.5f, 1.0f})
    for (const float u : {0.0f, 1e-6f, 0.3f, 0.5f, 0.7f, 1.0f}) {
      const Vec3<float> wi{std::sqrt(1 - z * z), 0, z};
      const Vec3<float> wm = sampler.sample(wi, alpha, u, 1 - u);
      require(std::abs(dot(wm, wm) - 1) < 1e-5f && wm.z >= 0, "a normal is not of unit length");
      require(!(sampler.pdf(wi, wm, alpha) < 0), "a density is negative");
      const auto sampled = sampler.sample_with_density(wi, alpha, u, u);
      require(!(sampled.pdf < 0), "a sampled density is negative");
      (void)sampler.invert(wi, sampled.wm, alpha);
    }
}

}  // namespace vndf::fuzz
