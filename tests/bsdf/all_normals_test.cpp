// Algorithm 1 for any distribution: all normals from a sampler of visible ones.
#include "vndf/bsdf/all_normals.h"

#include "support/bsdf_inputs.h"
#include "support/catch.h"

using namespace vndf;
using namespace vndf::test;

static_assert(NormalSampler<AllNormals<ExactGgx<double>>, double>);
static_assert(!AllNormals<ExactGgx<double>>::kVisible);

TEST_CASE("the density of all normals is D(wm) wm.z, whatever the incident direction") {
  const ExactGgx<double> ggx;
  const AllNormals<ExactGgx<double>> all(ggx);
  RandomInputs random(1);
  for (int i = 0; i < 1000; ++i) {
    const auto in = random.hard();
    const auto m = all.sample(in.wi, in.alpha, in.u1, in.u2);
    CAPTURE(in.alpha.x, in.alpha.y, m.x, m.y, m.z);
    REQUIRE(all.pdf(in.wi, m, in.alpha) == Approx(ggx.d(m, in.alpha) * m.z));
    REQUIRE(all.d(m, in.alpha) == ggx.d(m, in.alpha));
    REQUIRE(all.lambda(in.wi, in.alpha) == ggx.lambda(in.wi, in.alpha));
    REQUIRE(all.g1(in.wi, in.alpha) == ggx.g1(in.wi, in.alpha));
  }
}

TEST_CASE("all normals of GGX have the slopes of its closed quantile") {
  // P(slope / alpha < r) = r^2 / (1 + r^2), and the azimuth is uniform.
  const AllNormals<ExactGgx<double>> all{ExactGgx<double>{}};
  const auto grazing = direction_at<double>(89);
  for (const double u1 : {0.05, 0.3, 0.8})
    for (const double u2 : {0.01, 0.5, 0.99}) {
      const auto m = all.sample(grazing, {0.3, 0.3}, u1, u2);
      const double r = std::hypot(m.x, m.y) / m.z / 0.3;
      CHECK(r * r / (1 + r * r) == Approx(u2));
    }
}
