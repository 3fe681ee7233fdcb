// The inputs of the benchmark.
#include "vndf/bench/sample_inputs.h"

#include <cmath>

#include "support/catch.h"

using namespace vndf::bench;

TEST_CASE("inputs are whole blocks of directions, roughness and random numbers in their ranges") {
  SampleInputs inputs(SampleInputs::kBlock + 1);
  CHECK(inputs.size() == 2 * SampleInputs::kBlock);
  const SampleBlock b = inputs.next();
  REQUIRE(b.size() == SampleInputs::kBlock);
  REQUIRE(b.wm_z.size() == b.size());
  double mean_z = 0;
  for (std::size_t k = 0; k < b.size(); ++k) {
    REQUIRE(std::abs(std::hypot(b.wi_x[k], b.wi_y[k], b.wi_z[k]) - 1) < 1e-6);
    REQUIRE(b.wi_z[k] > 0);
    for (const float a : {b.alpha_x[k], b.alpha_y[k]}) REQUIRE((a >= 0.0499f && a <= 1));
    for (const float u : {b.u1[k], b.u2[k]}) REQUIRE((u >= 0 && u < 1));
    mean_z += b.wi_z[k] / static_cast<double>(b.size());
  }
  // Uniform over the hemisphere: the mean of z is 1/2, with a deviation of 0.29 / 64.
  CHECK(std::abs(mean_z - 0.5) < 5 * 0.29 / 64);
}

TEST_CASE("blocks follow each other and begin again after the last") {
  SampleInputs inputs(2 * SampleInputs::kBlock);
  const float* first = inputs.next().u1.data();
  CHECK(inputs.next().u1.data() == first + SampleInputs::kBlock);
  CHECK(inputs.next().u1.data() == first);
}

TEST_CASE("the same seed gives the same inputs, another seed others") {
  SampleInputs a(1, 7), b(1, 7), c(1, 8);
  const float u = a.next().u2[100];
  CHECK(b.next().u2[100] == u);
  CHECK(c.next().u2[100] != u);
}

TEST_CASE("the coherent direction is a unit vector above the horizon") {
  CHECK(std::abs(std::sqrt(dot(kCoherentWi, kCoherentWi)) - 1) < 1e-6);
  CHECK(kCoherentWi.z > 0);
}

TEST_CASE("inputs beyond the caches take at least 2 MiB") {
  CHECK(samples_beyond_caches() * kInputBytes >= (std::size_t{2} << 20));
}
