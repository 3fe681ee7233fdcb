// Surfaces, directions and integrals for the tests of the BSDFs.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/directions.h"
#include "support/exact_ggx.h"
#include "support/random_inputs.h"
#include "vndf/bsdf/all_normals.h"
#include "vndf/bsdf/normal_sampler.h"
#include "vndf/reference/v_cavity.h"

namespace vndf::test {

/// The visible normals of V-cavities of GGX (Algorithm 3).
using ExactVCavity = VCavity<AllNormals<ExactGgx<double>>>;

/// A direction uniform in theta and azimuth.
inline Vec3<double> random_direction(RandomInputs& random, double largest_degrees) {
  return direction_at<double>(largest_degrees * random.uniform(), 360 * random.uniform());
}

/// int f(w) dw over the upper hemisphere, by the midpoint rule in w.z and azimuth.
template <class F>
double over_hemisphere(F f, int rings = 600) {
  const int spokes = rings;
  double sum = 0;
  for (int i = 0; i < rings; ++i) {
    const double z = (i + 0.5) / rings, s = std::sqrt(1 - z * z);
    for (int j = 0; j < spokes; ++j) {
      const double phi = 2 * std::numbers::pi * (j + 0.5) / spokes;
      sum += f(Vec3<double>{s * std::cos(phi), s * std::sin(phi), z});
    }
  }
  return sum * 2 * std::numbers::pi / rings / spokes;
}

}  // namespace vndf::test
