// The validator passes the exact reference samplers. In the published ones it finds the defects
// that their headers state, as large as stated.
#include "vndf/validate/sampler/named_samplers.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "support/catch.h"
#include "vndf/reference/beckmann_analytic.h"
#include "vndf/reference/ggx_analytic.h"
#include "vndf/reference/ggx_ndf.h"
#include "vndf/reference/walter_roughness.h"
#include "vndf/validate/checks/furnace_check.h"
#include "vndf/validate/checks/quasi_random_check.h"
#include "vndf/validate/checks/u_error_check.h"
#include "vndf/validate/sampler/widened_surface.h"
#include "vndf/validate/validate.h"

using namespace vndf;
using namespace vndf::validate;
using namespace vndf::test;

namespace {

SamplerUnderTest sampler_of(const std::string& name) {
  const NamedSampler& named = find_sampler(name);
  return named.make(named.name, std::make_shared<ExactSlopes>(named.make_distribution()));
}

const CheckResult& find(const std::vector<CheckResult>& results, const std::string& statistic) {
  for (const CheckResult& f : results)
    if (f.statistic == statistic) return f;
  FAIL("no statistic " << statistic);
  return results.front();
}

/// Samplers that are right, and those with a published defect.
const std::vector<std::string> kRight{"beckmann-exact",    "ggx-exact",    "ggx-hemisphere",
                                      "ggx-caps",          "beckmann-ndf", "ggx-ndf",
                                      "beckmann-walter",   "ggx-walter",   "gtr-2-ndf",
                                      "beckmann-v-cavity", "ggx-v-cavity"};
const std::vector<std::string> kDefective{"beckmann-analytic", "ggx-analytic", "blinn-phong-ndf",
                                          "gtr-1.5-ndf"};

/// Walter's trick with its constants exchanged: 0.8 + 0.2 sqrt(cos(theta)) instead of 1.2 - ...
template <class T>
class WidenedWrongly : public WalterRoughness<GgxNdf<T>> {
 public:
  Vec3<T> sample(const Vec3<T>& wi, const Alpha<T>& alpha, T u1, T u2) const noexcept {
    const T factor = T(0.8) + T(0.2) * std::sqrt(std::abs(wi.z));
    return GgxNdf<T>().sample(wi, {factor * alpha.x, factor * alpha.y}, u1, u2);
  }
};

}  // namespace

TEST_CASE("every reference sampler has a verdict to expect") {
  std::size_t expected = 0;
  for (const NamedSampler& s : named_samplers())
    for (const auto* list : {&kRight, &kDefective})
      for (const std::string& name : *list) expected += s.name == name;
  CHECK(expected == named_samplers().size());
}

TEST_CASE("an unknown name is refused with the nearest known one") {
  CHECK_THROWS_WITH(find_sampler("ggx-cap"), contains("ggx-caps") && contains("'ggx-cap'"));
}

TEST_CASE("the hemisphere construction of GGX passes, with a fixed seed") {
  const Verdict v = validate_sampler(sampler_of("ggx-hemisphere"),
                                     {.thoroughness = Thoroughness::quick, .seed = 11});
  for (const CheckResult& f : v.results) {
    CAPTURE(f.check, f.statistic, f.measured, f.bound, f.where.theta);
    CHECK(f.passed());
  }
}

TEST_CASE("the exact maps of GGX and Beckmann have no u-error but rounding") {
  constexpr double kRounding = 2e-7;  // GgxExactMethod::kFloatError, of both
  for (const std::string name : {"ggx-exact", "beckmann-exact"}) {
    const auto results = check_u_error(sampler_of(name), {.places = 150, .slopes = 2, .stride = 4});
    CAPTURE(name);
    CHECK(find(results, "u-error of slope x").measured < kRounding);
    CHECK(find(results, "u-error of slope y").measured < kRounding);
  }
}

TEST_CASE("the rational fit of GGX errs in slope y as its header says, and ends in the tail") {
  const auto results =
      check_u_error(sampler_of("ggx-analytic"), {.places = 150, .slopes = 3, .stride = 4});
  const CheckResult& tails = find(results, "u-error of slope y, tails");
  CHECK_FALSE(tails.passed());
  CHECK(tails.measured == Approx(GgxAnalyticMethod::kFitError).epsilon(0.02));
  CHECK_FALSE(find(results, "u-error of slope y").passed());
  // What lies beyond its last slope on each side is all in the tail.
  CHECK(find(results, "tail mass / 2^-20 - 1, slope y").measured ==
        Approx(GgxAnalyticMethod::kFitError / 0x1p-20).epsilon(0.02));
}

TEST_CASE("the cones of the analytic methods are found, as large as at their edge") {
  constexpr std::size_t kPoints = 200000;
  const auto distance = [](const std::string& name) {
    const auto results = check_quasi_random(sampler_of(name), kPoints, {});
    return find(results, "slope x, distance of cdfs");
  };
  const CheckResult beckmann = distance("beckmann-analytic"), ggx = distance("ggx-analytic");
  CHECK_FALSE(beckmann.passed());
  CHECK_FALSE(ggx.passed());
  // The configuration nearest to the edge, 0.25 of 0.256 degrees, has 0.976 of its error.
  CHECK(beckmann.measured == Approx(BeckmannAnalyticMethod::kConeError).epsilon(0.15));
  CHECK(ggx.measured == Approx(GgxAnalyticMethod::kConeError).epsilon(0.15));
  CHECK(ggx.where.theta == Approx(0.25).epsilon(1e-3));
}

TEST_CASE("masking that is of another distribution is found") {
  for (const std::string name : {"blinn-phong-ndf", "gtr-1.5-ndf"})
    CHECK_FALSE(find(check_furnace(sampler_of(name), {}), "weak white furnace - 1").passed());
}

TEST_CASE("Walter's widened roughness is checked by the paper's factor, not by the sampler's") {
  const SamplerUnderTest right = sampler_of("ggx-walter");
  const SamplerUnderTest wrong = under_test<float>(
      "mistaken", right.exact, WidenedSurface<float, WidenedWrongly<float>>(), right.claims);
  CHECK(all_passed(check_quasi_random(right, 20000, {})));
  CHECK_FALSE(all_passed(check_quasi_random(wrong, 20000, {})));
}

TEST_CASE("every reference sampler gets its verdict at the default setting", "[.slow]") {
  const std::uint64_t seed = std::random_device{}();
  CAPTURE(seed);
  for (const NamedSampler& s : named_samplers()) {
    const bool right = std::find(kRight.begin(), kRight.end(), s.name) != kRight.end();
    CAPTURE(s.name);
    CHECK(validate_sampler(sampler_of(s.name), {.seed = seed}).passed() == right);
  }
}
