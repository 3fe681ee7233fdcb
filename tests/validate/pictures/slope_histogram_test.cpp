// The exact density in the pictures of sampled slopes is compared with its marginals and a count of
// points, and the scatter of samples with their noise. A mistake must show.
#include "vndf/validate/pictures/slope_histogram.h"

#include <cmath>
#include <numbers>
#include <numeric>

#include "support/catch.h"
#include "support/samplers_under_test.h"

using namespace vndf;
using namespace vndf::validate;
using namespace vndf::test;

namespace {

constexpr double kPi = std::numbers::pi;

SamplerUnderTest caps_of(const std::string& distribution) {
  return under_test<float>("caps", exact_slopes(distribution), CapsGgx<float>{}, Claims{});
}

/// A sampler of which only the exact distribution is asked.
SamplerUnderTest claim_of(const std::string& distribution, SampledNormals kind) {
  return under_test<float>("claim", exact_slopes(distribution), CapsGgx<float>{},
                           Claims{.normals = kind});
}

double sum(const Grid& grid) {
  return std::accumulate(grid.values.begin(), grid.values.end(), 0.0);
}

}  // namespace

TEST_CASE("the exact density has the mass 1 where all slopes are in the picture") {
  constexpr std::size_t kCells = 31;
  for (const SampledNormals kind :
       {SampledNormals::visible_smith, SampledNormals::visible_v_cavity, SampledNormals::all})
    for (const double theta : {0.0, 60.0, 90.0}) {
      const SamplerUnderTest disk = claim_of("disk", kind);
      const Configuration c = at_angles(theta, 45, 2, 1);
      const double w = shown_slopes(*disk.exact, c.alpha), side = 2 * w / kCells;
      CAPTURE(static_cast<int>(kind), theta);
      CHECK(sum(exact_slope_density(disk, c, w, kCells)) * side * side ==
            Approx(1).margin(kCellError));
    }
}

TEST_CASE("columns of the exact density are steps of the marginal CDF") {
  // The CDF comes from integrals over one variable (marginal_distribution.h) and knows no cells.
  const SamplerUnderTest beckmann = claim_of("beckmann", SampledNormals::visible_smith);
  const auto& slopes = beckmann.exact->unit_slopes();
  const Configuration c = at_angles(60, 0, 1, 1);
  const precompute::MarginalDistribution visible(slopes,
                                                 StretchedFrame(*beckmann.exact, c).cotangent());
  constexpr std::size_t kCells = 41;
  constexpr double kHalfWidth = 5, kSide = 2 * kHalfWidth / kCells;  // exp(-25) lies beyond
  const Grid exact = exact_slope_density(beckmann, c, kHalfWidth, kCells);
  const auto cdf = [&](double x) {
    return visible.cdf(std::min(std::asinh(x / slopes.mean_slope()), visible.farthest())).u;
  };
  for (std::size_t i = 0; i < kCells; ++i) {
    double column = 0;
    for (std::size_t j = 0; j < kCells; ++j) column += exact.at(i, j) * kSide * kSide;
    const double x = -kHalfWidth + static_cast<double>(i) * kSide;
    CAPTURE(x);
    CHECK(column == Approx(cdf(x + kSide) - cdf(x)).margin(1e-6));
  }
}

TEST_CASE("cells through which the rim of a disk passes are as full as a count of points says") {
  constexpr std::size_t kCells = 21, kPoints = 300;
  constexpr double kHalfWidth = 1.1, kSide = 2 * kHalfWidth / kCells;
  const SamplerUnderTest disk = claim_of("disk", SampledNormals::all);
  const Grid exact = exact_slope_density(disk, at_angles(0, 0, 1, 1), kHalfWidth, kCells);
  double worst = 0;
  for (std::size_t j = 0; j < kCells; ++j)
    for (std::size_t i = 0; i < kCells; ++i) {
      std::size_t inside = 0;
      for (std::size_t k = 0; k < kPoints * kPoints; ++k) {
        const auto place = [&](std::size_t cell, std::size_t point) {
          const double step = (static_cast<double>(point) + 0.5) / kPoints;
          return -kHalfWidth + (static_cast<double>(cell) + step) * kSide;
        };
        inside += std::hypot(place(i, k % kPoints), place(j, k / kPoints)) < 1;
      }
      const double density = static_cast<double>(inside) / (kPoints * kPoints) / kPi;
      worst = std::max(worst, std::abs(exact.at(i, j) - density));
    }
  CHECK(worst < kCellError / kPi);
}

TEST_CASE("the deviate of a count is that of Poisson's distribution, summed term by term") {
  constexpr double kExpected = 3.7;
  double less = 0, equal = std::exp(-kExpected);
  for (std::uint64_t k = 0; k < 14; ++k) {
    const double deviate = poisson_deviate(k, kExpected);
    CAPTURE(k);
    CHECK(std::erfc(-deviate / std::numbers::sqrt2) / 2 == Approx(less + equal / 2).margin(1e-10));
    less += equal;
    equal *= kExpected / static_cast<double>(k + 1);
  }
}

TEST_CASE("the deviate of many is the distance in standard errors") {
  CHECK(poisson_deviate(1002000, 1e6) == Approx(2).margin(2e-3));
  CHECK(poisson_deviate(998000, 1e6) == Approx(-2).margin(2e-3));
}

TEST_CASE("a sample where none may be deviates most, none there not at all") {
  CHECK(poisson_deviate(0, 0) == 0);
  CHECK(poisson_deviate(1, 0) == kLargestDeviation);
  CHECK(poisson_deviate(1000, 1e-3) == kLargestDeviation);
  CHECK(poisson_deviate(0, 1e6) == -kLargestDeviation);
  CHECK(std::abs(poisson_deviate(0, 1e-12)) < 1e-9);
}

TEST_CASE("samples of an exact sampler scatter by their noise alone") {
  const SamplerUnderTest caps = caps_of("ggx");
  for (const double theta : {0.0, 60.0, 90.0}) {
    const Configuration c = at_angles(theta, 45, 2, 1);
    const double w = shown_slopes(*caps.exact, c.alpha);
    const SlopeHistogram h =
        slope_histogram(caps, c, w, {.cells = 41, .samples = 200000, .seed = 5});
    const double side = 2 * w / 41, n = static_cast<double>(h.samples);
    CAPTURE(theta);
    REQUIRE(h.compared > 100);
    CHECK(std::abs(h.mean_square - 1) < 5 * std::sqrt(2 / static_cast<double>(h.compared)));
    CHECK(std::abs(sum(h.sampled) * side * side - h.inside) <
          5 * std::sqrt(h.inside * (1 - h.inside) / n));
  }
}

TEST_CASE("samples of another distribution deviate by more than their noise") {
  const Configuration c = at_angles(60, 45, 2, 1);
  const SamplerUnderTest wrong = caps_of("student-t:gamma=2.1");  // GGX is 2
  const SlopeHistogram h = slope_histogram(wrong, c, shown_slopes(*wrong.exact, c.alpha),
                                           {.cells = 41, .samples = 200000, .seed = 5});
  CHECK(h.mean_square > 1 + 10 * std::sqrt(2 / static_cast<double>(h.compared)));
}

TEST_CASE("a histogram does not depend on the number of threads, but on its seed and stream") {
  const SamplerUnderTest caps = caps_of("ggx");
  const Configuration c = at_angles(30, 45, 2, 1);
  const auto sampled = [&](std::uint64_t seed, std::uint64_t stream, unsigned threads) {
    return slope_histogram(caps, c, 3,
                           {.cells = 9,
                            .samples = 100000,
                            .seed = seed,
                            .stream = stream,
                            .workers = {threads}})
        .sampled.values;
  };
  CHECK(sampled(1, 0, 1) == sampled(1, 0, 3));
  CHECK(sampled(1, 0, 1) != sampled(2, 0, 1));
  CHECK(sampled(1, 0, 1) != sampled(1, 1, 1));
}

TEST_CASE("a picture shows all slopes of a bounded distribution and most of any other") {
  CHECK(shown_slopes(*exact_slopes("disk"), {2, 1}) == Approx(2.1));
  // P(R < r) = r^2 / (1 + r^2) of GGX
  const double r = shown_slopes(*exact_slopes("ggx"), {1, 1}) / 1.05;
  CHECK(r * r / (1 + r * r) == Approx(0.85));
}
