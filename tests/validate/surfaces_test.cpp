// The validator judges samplers on surfaces with correlated slopes and a mean slope, and from below
// them: right ones pass, at directions of the whole sphere too, and each mistake is seen.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "support/built_tables.h"
#include "support/catch.h"
#include "support/drawn_records.h"
#include "support/samplers_under_test.h"
#include "vndf/precompute/bake_certified.h"
#include "vndf/reference/ggx_caps.h"
#include "vndf/reference/ggx_exact.h"
#include "vndf/validate/checks/configurations.h"
#include "vndf/validate/checks/u_error_check.h"
#include "vndf/validate/statistics/block_random.h"
#include "vndf/validate/validate.h"
#include "vndf/validate/validate_records.h"

using namespace vndf;
using namespace vndf::validate;
using namespace vndf::test;

namespace {

using Numbers = std::pair<double, Vec2<double>>;

/// The surface with a correlation and a mean slope, at every roughness.
std::function<SurfaceSlopes(const Alpha<double>&)> surface(double correlation,
                                                           const Vec2<double>& mean) {
  return [=](const Alpha<double>& alpha) { return SurfaceSlopes{alpha, correlation, mean}; };
}

SamplerUnderTest pair_of(const std::string& distribution) {
  const auto& built = small_tables(distribution);
  return tables_under_test(distribution, exact_slopes(distribution), built.tables,
                           built.certificate);
}

SamplerUnderTest baked_of(const std::string& distribution) {
  return baked_tables_under_test(
      distribution, exact_slopes(distribution),
      precompute::bake_certified(*distributions::parse_distribution(distribution),
                                 *small_tables(distribution).tables, {.tolerance = 1e-4}));
}

SamplerUnderTest caps() {
  return under_test("caps", exact_slopes("ggx"), GgxCaps<float>{}, GgxCaps<double>{}, {});
}

SamplerUnderTest inverse() {
  return under_test("inverse", exact_slopes("ggx"), GgxExact<float>{}, GgxExact<double>{},
                    {.monotone_inverse = true});
}

std::string first_failure(const SamplerUnderTest& sampler) {
  const Verdict v = validate_sampler(
      sampler, {.thoroughness = Thoroughness::quick, .seed = 3, .stop_at_first_failure = true});
  return v.passed() ? "" : v.first_failure()->statistic;
}

/// `sampler`, which draws what is seen at changed(c) in place of c.
template <class Change>
SamplerUnderTest misled(SamplerUnderTest sampler, Change change) {
  const auto changed = [change](Configuration c) {
    change(c);
    return c;
  };
  sampler.sample = [good = sampler.sample, changed](const auto& c, auto u, auto wm) {
    good(changed(c), u, wm);
  };
  sampler.pdf = [good = sampler.pdf, changed](const auto& c, auto wm, auto pdf) {
    good(changed(c), wm, pdf);
  };
  sampler.d = [good = sampler.d, changed](const ExactSurface& s, auto wm, auto d) {
    good(changed({{0, 0, 1}, s.alpha, s.correlation, s.mean}).surface(), wm, d);
  };
  sampler.sample_double = {};
  return sampler;
}

/// Directions of the whole sphere, evenly (Gonzalez 2010).
std::vector<Vec3<double>> sphere(std::size_t count) {
  std::vector<Vec3<double>> list;
  for (std::size_t k = 0; k < count; ++k) {
    const double z = 1 - (2 * static_cast<double>(k) + 1) / static_cast<double>(count);
    const double phi = 2 * std::numbers::pi * static_cast<double>(k) * std::numbers::phi;
    const double s = std::sqrt(1 - z * z);
    list.push_back({to_single(s * std::cos(phi)), to_single(s * std::sin(phi)), to_single(z)});
  }
  return list;
}

const std::vector<Numbers> kNineSurfaces{{0, {0, 0}},     {0, {0.7, -0.4}},     {0, {2, 1}},
                                         {0.5, {0, 0}},   {0.5, {0.7, -0.4}},   {0.5, {2, 1}},
                                         {-0.95, {0, 0}}, {-0.95, {0.7, -0.4}}, {-0.95, {2, 1}}};

/// How much is counted.
struct Counting {
  std::uint64_t samples = 30000;  ///< at each configuration
  std::uint64_t seed = 1;
};

/// The counts at single configurations, and of all their normals together, with their bounds.
struct Law {
  std::vector<CheckResult> results;
  std::uint64_t configurations = 0;
};

/// The counts of `sampler` on each of `surfaces` from each of `directions` that sees enough.
Law count_law(const SamplerUnderTest& sampler, const std::vector<Numbers>& surfaces,
              const std::vector<Vec3<double>>& directions, const Counting& counting) {
  constexpr std::size_t kBatch = 1000;
  Law law;
  std::vector<RandomPair> u(kBatch);
  std::vector<Vec3<double>> wm(kBatch);
  UniformCounts all(bins_for(counting.samples));
  for (const auto& [correlation, mean] : surfaces)
    for (const Vec3<double>& wi : directions) {
      const Configuration c{wi,
                            {to_single(0.6), to_single(0.4)},
                            correlation,
                            {to_single(mean.x), to_single(mean.y)}};
      if (!sampler.claims_to_see(c)) continue;
      const ExactDistribution exact(*sampler.exact, sampler.claims.normals, c);
      UniformCounts counts(bins_for(counting.samples));
      BlockRandom random(counting.seed, law.configurations++, 0);
      for (std::uint64_t done = 0; done < counting.samples; done += kBatch) {
        for (RandomPair& p : u) {
          p.x = random.single();
          p.y = random.single();
        }
        sampler.sample(c, u, wm);
        for (const Vec3<double>& m : wm) counts.add(exact.uniforms(m, random.uniform()));
      }
      all.add(counts);
      merge_results(law.results, counts.results(sampler.bounds_at(c).declared, "law", place_of(c)));
    }
  for (const CheckResult& f : all.results(sampler.bounds.declared, "law of all", {}))
    law.results.push_back(f);
  bound_probabilities(law.results, kRunSignificance, number_of_tests(law.results));
  return law;
}

/// The smallest p-value of all tests, as if there were one.
double least_p(const Law& law) {
  double least = 1;
  for (const CheckResult& f : law.results) least = std::min(least, f.measured);
  return 1 - std::pow(1 - least, static_cast<double>(number_of_tests(law.results)));
}

void check_law(const SamplerUnderTest& sampler, const Law& law) {
  for (const CheckResult& f : law.results) {
    CAPTURE(sampler.name, f.statistic, f.measured, f.bound, f.where.theta, f.where.correlation,
            f.where.mean_x, f.note);
    CHECK(f.passed());
  }
}

}  // namespace

TEST_CASE("right samplers pass all checks on surfaces") {
  struct Case {
    SamplerUnderTest sampler;
    Numbers numbers;
  };
  for (Case& one :
       std::vector<Case>{{inverse(), {-0.95, {0.7, -0.4}}}, {baked_of("ggx"), {0.5, {2, 1}}}}) {
    one.sampler.surface = surface(one.numbers.first, one.numbers.second);
    const Verdict v =
        validate_sampler(one.sampler, {.thoroughness = Thoroughness::quick, .seed = 3});
    for (const CheckResult& f : v.results) {
      CAPTURE(one.sampler.name, f.check, f.statistic, f.measured, f.bound, f.where.theta,
              f.where.alpha_x, f.where.alpha_y);
      CHECK(f.passed());
    }
  }
}

TEST_CASE("a correlation that is off by 0.01 is seen, whatever the map") {
  for (SamplerUnderTest sampler : {inverse(), caps(), pair_of("beckmann")}) {
    sampler.surface = surface(0.5, {0.7, -0.4});
    CAPTURE(sampler.name);
    CHECK(first_failure(misled(sampler, [](Configuration& c) { c.correlation += 0.01; })) != "");
  }
}

TEST_CASE("a mean slope of the wrong sign, or none, and exchanged roughness are seen") {
  SamplerUnderTest sampler = pair_of("beckmann");
  sampler.surface = surface(0.5, {0.1, 0});
  CHECK(first_failure(misled(sampler, [](Configuration&) {})) == "");
  CHECK(first_failure(misled(sampler, [](Configuration& c) { c.mean.x = -c.mean.x; })) != "");
  CHECK(first_failure(misled(sampler, [](Configuration& c) { c.mean = {0, 0}; })) != "");
  CHECK(first_failure(misled(sampler, [](Configuration& c) { c.correlation = 0; })) != "");
  CHECK(first_failure(misled(sampler, [](Configuration& c) { std::swap(c.alpha.x, c.alpha.y); })) !=
        "");
}

TEST_CASE("a density that is not that of the surface is seen") {
  SamplerUnderTest sampler = caps();
  sampler.surface = surface(0.5, {0.1, 0});
  SamplerUnderTest wrong = sampler;
  wrong.pdf = [good = sampler.pdf](const Configuration& c, auto wm, auto pdf) {
    good({c.wi, c.alpha, c.correlation, {0, 0}}, wm, pdf);
  };
  CHECK(first_failure(wrong) != "");
  // Without the determinant of the stretch.
  wrong.pdf = [good = sampler.pdf](const Configuration& c, auto wm, auto pdf) {
    good(c, wm, pdf);
    for (double& p : pdf) p *= std::sqrt(1 - c.correlation * c.correlation);
  };
  CHECK(first_failure(wrong) != "");
  // Lambda and G1 relative to the z axis.
  wrong = sampler;
  wrong.g1 = [good = sampler.g1](const Configuration& c) { return good(c) * c.wi.z / c.height(); };
  CHECK(first_failure(wrong) == "G1");
}

TEST_CASE("from below the horizon, what a sampler draws from above is seen to be wrong") {
  const SamplerUnderTest sampler = pair_of("beckmann");
  const auto from_above = [](Configuration& c) { c.wi.z = std::abs(c.wi.z); };
  const auto to_the_horizon = [](Configuration& c) { c.wi.z = std::max(c.wi.z, 0.0); };
  CHECK(first_failure(misled(sampler, from_above)) != "");
  CHECK(first_failure(misled(sampler, to_the_horizon)) != "");
  const auto a_little = [](Configuration& c) { c.wi.z = c.wi.z < 0 ? c.wi.z * 1.02 : c.wi.z; };
  const std::string statistic = first_failure(misled(sampler, a_little));
  CHECK(statistic == "u-error of slope x, below");
}

TEST_CASE("configurations on a surface are those of the mean facet") {
  SamplerUnderTest sampler = pair_of("ggx");
  const auto flat = check_configurations(sampler);
  CHECK(std::any_of(flat.begin(), flat.end(), [](const auto& c) { return c.wi.z < 0; }));
  CHECK(left_out(sampler).empty());
  sampler.surface = surface(0.5, {0.7, -0.4});
  const auto tilted = check_configurations(sampler);
  CHECK(tilted.size() + left_out(sampler).size() == flat.size());
  CHECK(left_out(sampler).size() == 3);
  const Configuration c = on_surface(sampler, at_angles(60, 30, 1, 1));
  CHECK(c.incidence() == Approx(60).epsilon(1e-6));
  CHECK(c.correlation == 0.5);
  CHECK(c.mean.x == to_single(0.7));
  sampler.claims.from_below = false;
  for (const Configuration& one : check_configurations(sampler)) CHECK(one.height() > 0);
}

TEST_CASE("a surface that single precision cannot carry is refused") {
  SamplerUnderTest sampler = caps();
  sampler.surface = surface(0.99999, {0, 0});
  CHECK_THROWS_WITH(validate_sampler(sampler),
                    contains("caps") && contains("give a correlation nearer to 0"));
}

TEST_CASE("normals from the whole sphere have the exact distribution on surfaces") {
  const std::vector<Numbers> some{kNineSurfaces[1], kNineSurfaces[5], kNineSurfaces[7]};
  for (const std::string name : {"ggx", "beckmann", "exponential-power:p=0.5"}) {
    const SamplerUnderTest sampler = pair_of(name);
    const Law law = count_law(sampler, some, sphere(7), {});
    CHECK(law.configurations >= 15);
    check_law(sampler, law);
    const auto wrong = misled(sampler, [](Configuration& c) { c.correlation *= 0.8; });
    CHECK_FALSE(all_passed(count_law(wrong, {kNineSurfaces[7]}, sphere(7), {}).results));
  }
}

/// The number that an environment variable has, or `plain`.
double number_of(const char* variable, double plain) {
  const char* text = std::getenv(variable);
  return text == nullptr ? plain : std::atof(text);
}

TEST_CASE("1e8 normals from the whole sphere have the exact distribution on nine surfaces",
          "[.slow]") {
  const auto directions = sphere(20);
  const double share = number_of("VNDF_LAW_SAMPLES", 1e8) /
                       static_cast<double>(kNineSurfaces.size() * directions.size());
  const Counting counting{static_cast<std::uint64_t>(share),
                          static_cast<std::uint64_t>(number_of("VNDF_TEST_SEED", 1))};
  for (const std::string name : {"ggx", "beckmann", "exponential-power:p=0.5"}) {
    const auto& built = large_tables(name);
    const SamplerUnderTest pair =
        tables_under_test(name, exact_slopes(name), built.tables, built.certificate);
    const Law law = count_law(pair, kNineSurfaces, directions, counting);
    check_law(pair, law);
    WARN(name << ": the least p-value of " << law.configurations << " configurations is "
              << least_p(law) << ", allowing for their number");
    const auto wrong = misled(pair, [](Configuration& c) { c.correlation += 0.01; });
    CHECK_FALSE(all_passed(count_law(wrong, {kNineSurfaces[4]}, directions, counting).results));
  }
}
