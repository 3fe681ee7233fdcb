// The curves of a distribution are compared with closed forms.
#include "vndf/validate/pictures/distribution_curves.h"

#include <cmath>
#include <numbers>

#include "support/catch.h"
#include "support/samplers_under_test.h"
#include "vndf/validate/sampler/named_samplers.h"

using namespace vndf;
using namespace vndf::validate;
using namespace vndf::test;

namespace {

constexpr std::size_t kPlaces = 60;

DistributionCurves ggx_curves() {
  const auto& named = find_sampler("ggx-exact");
  return distribution_curves(named.make(named.name, exact_slopes("ggx")), {0.1, 1}, kPlaces);
}

/// `closed(at)` against both values of every place.
template <class F>
void check(const Curve& curve, F closed) {
  REQUIRE(curve.at.size() == kPlaces);
  REQUIRE(curve.exact.size() == kPlaces);
  REQUIRE(curve.sampler.size() == kPlaces);
  for (std::size_t k = 0; k < kPlaces; ++k) {
    CAPTURE(curve.alpha, curve.at[k]);
    // The direction is rounded to single precision, which D at its steepest multiplies by 100.
    CHECK(curve.exact[k] == Approx(closed(curve.at[k])).epsilon(2e-5));
    CHECK(curve.sampler[k] == Approx(closed(curve.at[k])).epsilon(2e-5));
  }
}

}  // namespace

TEST_CASE("curves of GGX are its closed forms") {
  const DistributionCurves curves = ggx_curves();
  check(curves.p22, [](double r) { return 1 / (std::numbers::pi * std::pow(1 + r * r, 2)); });
  REQUIRE(curves.lambda.size() == 2);
  REQUIRE(curves.d.size() == 2);
  for (std::size_t k = 0; k < 2; ++k) {
    const double alpha = curves.d[k].alpha;
    check(curves.lambda[k], [alpha](double theta) {
      return (std::hypot(1, alpha * std::tan(theta * kDegree)) - 1) / 2;
    });
    check(curves.d[k], [alpha](double theta) {
      const double cosine = std::cos(theta * kDegree), tangent = std::tan(theta * kDegree) / alpha;
      return 1 / (std::numbers::pi * alpha * alpha * std::pow(cosine, 4) *
                  std::pow(1 + tangent * tangent, 2));
    });
  }
}

TEST_CASE("p22 is shown as far as one slope in a million, or to the largest") {
  const auto at = ggx_curves().p22.at;
  CHECK(std::is_sorted(at.begin(), at.end()));
  CHECK(at.front() == Approx(0.01).epsilon(0.15));  // E|X| = 1
  CHECK(at.back() == Approx(1e3).epsilon(0.15));    // P(R > r) = 1 / (1 + r^2)
  const auto& named = find_sampler("ggx-exact");
  const SamplerUnderTest disk = named.make(named.name, exact_slopes("disk"));
  CHECK(distribution_curves(disk, {1}, kPlaces).p22.at.back() == Approx(1).epsilon(0.05));
}
