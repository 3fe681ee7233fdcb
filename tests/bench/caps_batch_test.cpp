// The baseline of the benchmark draws visible GGX normals, so that the ratio compares like with
// like.
#include "vndf/bench/caps_batch.h"

#include <cmath>
#include <numbers>

#include "support/batch_arrays.h"
#include "support/catch.h"
#include "support/random_inputs.h"

using namespace vndf;
using namespace vndf::test;

namespace {

/// The published formulas in double precision, written as rotations of the height of a cap.
Vec3<double> caps(const Vec3<float>& wi, const Alpha<float>& alpha, double u1, double u2) {
  const double ax = alpha.x, ay = alpha.y, length = std::hypot(ax * wi.x, ay * wi.y, double{wi.z});
  const double cos = wi.z / length, height = 1 - u2 * (1 + cos);
  const double radius = std::sqrt(std::max(0.0, (1 - height) * (1 + height)));
  const double phi = 2 * std::numbers::pi * u1;
  return normalize_or_up(Vec3<double>{ax * (radius * std::cos(phi) + ax * wi.x / length),
                                      ay * (radius * std::sin(phi) + ay * wi.y / length),
                                      height + cos});
}

}  // namespace

TEST_CASE("spherical caps in batches are the published map on every target") {
  constexpr double kCapsError = 1e-5;  // the cap's height is 1 less a product, and a root follows
  BatchArrays batch;
  RandomInputs random(31);
  for (int k = 0; k < 999; ++k) {
    const double z = 0.1 + 0.9 * random.uniform(), phi = 2 * std::numbers::pi * random.uniform();
    const double s = std::sqrt(1 - z * z);
    const auto number = [&] { return static_cast<float>(0.01 + 0.98 * random.uniform()); };
    const float ax = number(), ay = number(), u1 = number(), u2 = number();
    batch.add({static_cast<float>(s * std::cos(phi)), static_cast<float>(s * std::sin(phi)),
               static_cast<float>(z)},
              {ax, ay}, u1, u2);
  }
  for_each_target([&](const char* target) {
    CAPTURE(target);
    bench::caps_batch(batch.wi(), batch.alpha(), batch.u1, batch.u2, batch.wm());
    double worst = 0;
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const auto expected = caps({batch.wi_x[i], batch.wi_y[i], batch.wi_z[i]},
                                 {batch.alpha_x[i], batch.alpha_y[i]}, batch.u1[i], batch.u2[i]);
      worst = std::max(worst, angle_between(batch.normal(i), expected));
    }
    CHECK(worst <= kCapsError);
  });
}
