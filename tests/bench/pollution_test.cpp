// Polluting and chaining change when a sampler runs, not what it draws.
#include "vndf/bench/pollution.h"

#include <cmath>

#include "support/catch.h"
#include "vndf/bench/case.h"
#include "vndf/bench/published_caps.h"

using namespace vndf;
using namespace vndf::bench;

namespace {

constexpr float kGreatestChange = 1e-6f;

std::vector<float> normals_of(const SampleBlock& b) {
  std::vector<float> all;
  for (const auto& values : {b.wm_x, b.wm_y, b.wm_z})
    all.insert(all.end(), values.begin(), values.end());
  return all;
}

}  // namespace

TEST_CASE("reading the polluting lines gives 0 whatever the last normal") {
  Pollution pollution;
  for (const float last : {-1.7f, 0.0f, 1.0f, 1.7f}) CHECK(pollution.read(last) == 0);
}

TEST_CASE("a polluted run draws what the incoherent one does, a chained one to rounding") {
  const Runner r = scalar_runs<float>(PublishedCaps());
  SampleInputs inputs(1);
  const SampleBlock b = inputs.next();
  r.incoherent(b);
  const std::vector<float> expected = normals_of(b);

  Pollution pollution;
  r.polluted(b, pollution);
  CHECK(normals_of(b) == expected);

  r.chained(b);
  const std::vector<float> chained = normals_of(b);
  for (std::size_t k = 0; k < expected.size(); ++k)
    REQUIRE(std::abs(chained[k] - expected[k]) <= kGreatestChange);
}

TEST_CASE("in a chain each sample is given the normal before") {
  /// Adds one to the normal that comes with wi = 0.
  struct Counter {
    Vec3<double> sample(const Vec3<double>& wi, const Alpha<double>&, double, double) const {
      return {0, 0, wi.z / double{kTiny} + 1};
    }
  };
  std::vector<float> zeros(3, 0.0f), x(3), y(3), z(3);
  scalar_runs<double>(Counter()).chained(
      {zeros, zeros, zeros, zeros, zeros, zeros, zeros, x, y, z});
  CHECK(z == std::vector<float>{2, 3, 4});
}
