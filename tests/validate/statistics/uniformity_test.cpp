// Counts of uniform numbers pass where these are uniform, and each statistic sees its own kind of
// error.
#include "vndf/validate/statistics/uniformity.h"

#include <cmath>
#include <functional>
#include <random>

#include "support/catch.h"
#include "vndf/validate/statistics/significance.h"

using namespace vndf::validate;
using namespace vndf::test;

namespace {

constexpr std::uint64_t kSamples = 400000;

std::vector<CheckResult> check(const std::function<Uniforms(Uniforms)>& mistake,
                               const DeclaredErrors& declared = {}) {
  UniformCounts counts(bins_for(kSamples));
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> uniform;
  for (std::uint64_t k = 0; k < kSamples; ++k) {
    const double r = uniform(random), phi = uniform(random);
    counts.add(mistake({r, phi, uniform(random)}));
  }
  auto results = counts.results(declared, "distribution", {});
  bound_probabilities(results, kRunSignificance, number_of_tests(results));
  return results;
}

/// Names of the statistics that failed.
std::vector<std::string> failures(const std::vector<CheckResult>& results) {
  std::vector<std::string> names;
  for (const CheckResult& f : results)
    if (!f.passed()) names.push_back(f.statistic);
  return names;
}

using Names = std::vector<std::string>;

}  // namespace

TEST_CASE("uniform numbers pass every statistic") {
  CHECK(failures(check([](Uniforms w) { return w; })).empty());
}

TEST_CASE("a density off by one per cent in the mean is seen by the cumulative statistic") {
  const auto tilted = check([](Uniforms w) {
    w.r = w.r + 0.02 * w.r * (1 - w.r);
    return w;
  });
  CHECK(failures(tilted) == Names{"radius cdf"});
}

TEST_CASE("a lattice finer than the bins is seen by the chi-square") {
  const auto lattice = check([](Uniforms w) {
    w.phi = (std::floor(w.phi * 4096) + 0.5) / 4096;
    return w;
  });
  const auto names = failures(lattice);
  CHECK(std::find(names.begin(), names.end(), "azimuth chi-square") != names.end());
}

TEST_CASE("a tail that is cut at 1e-3 is seen by the octaves") {
  const auto cut = check([](Uniforms w) {
    w.x = std::max(w.x, 1e-3);
    return w;
  });
  const auto names = failures(cut);
  CHECK(std::find(names.begin(), names.end(), "slope x tails") != names.end());
}

TEST_CASE("numbers that are uniform one by one but depend on each other fail on the sphere") {
  const auto dependent = check([](Uniforms w) {
    w.phi = w.r < 0.5 ? w.phi / 2 + (w.phi < 0.5 ? 0 : 0.5) : w.phi;
    w.phi = std::fmod(w.r + 0.3 * w.phi, 1.0);
    return w;
  });
  const auto names = failures(dependent);
  CHECK(std::find(names.begin(), names.end(), "sphere chi-square") != names.end());
}

TEST_CASE("an error that is declared is allowed, a larger one is not") {
  const auto bent = [](Uniforms w) {
    w.r = w.r + 0.02 * w.r * (1 - w.r);  // 5e-3 in u, 2 % in density at most
    return w;
  };
  CHECK(failures(check(bent, {.u = 5e-3, .density = 0.02, .tail = 0.05})).empty());
  CHECK_FALSE(failures(check(bent, {.u = 1e-3, .density = 0.02, .tail = 0.05})).empty());
}

TEST_CASE("bins are prime, and as many as the samples fill with five each") {
  CHECK(bins_for(10000000).line == kBins);
  const BinCounts few = bins_for(1000);
  CHECK(few.line == 199);
  CHECK(few.side_r == 13);
}

TEST_CASE("merging keeps the worse result and adds the tests") {
  std::vector<CheckResult> all{{"distribution", "a", Kind::probability, 0.5, 0, {}, 3}};
  merge_results(all, {{"distribution", "a", Kind::probability, 0.1, 0, {}, 2},
                      {"distribution", "b", Kind::probability, 0.7, 0, {}, 1}});
  REQUIRE(all.size() == 2);
  CHECK(all[0].measured == 0.1);
  CHECK(number_of_tests(all) == 6);
}

TEST_CASE("a measurement that is not a number never passes") {
  CHECK_FALSE(CheckResult{"s", "x", Kind::error, kUnknown, 1}.passed());
  CHECK_FALSE(CheckResult{"s", "x", Kind::probability, kUnknown, 1e-9}.passed());
  Worst worst;
  worst.see(1, {});
  worst.see(kUnknown, {});
  worst.see(2, {});
  CHECK(std::isnan(worst.measured));
}
