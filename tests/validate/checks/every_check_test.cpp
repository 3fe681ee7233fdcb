// Every check is made for every kind of sampler that it applies to, has its bound, is told where it
// is not made, and measures a defect of known size as what it is.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "support/built_tables.h"
#include "support/catch.h"
#include "support/samplers_under_test.h"
#include "vndf/reference/ggx_exact.h"
#include "vndf/validate/checks/cross_check.h"
#include "vndf/validate/checks/density_check.h"
#include "vndf/validate/checks/distribution_check.h"
#include "vndf/validate/checks/hard_cases.h"
#include "vndf/validate/checks/quasi_random_check.h"
#include "vndf/validate/checks/u_error_check.h"
#include "vndf/validate/sampler/named_samplers.h"
#include "vndf/validate/validate.h"

using namespace vndf;
using namespace vndf::validate;
using namespace vndf::test;

namespace {

using Names = std::set<std::string>;

SamplerUnderTest named(const std::string& name) {
  const NamedSampler& s = find_sampler(name);
  return s.make(s.name, std::make_shared<ExactSlopes>(s.make_distribution()));
}

SamplerUnderTest tables() {
  const auto& built = small_tables("ggx");
  return tables_under_test("tables", exact_slopes("ggx"), built.tables, built.certificate);
}

SamplerUnderTest exact_inverse() {
  return under_test("inverse", exact_slopes("ggx"), GgxExact<float>{}, GgxExact<double>{},
                    {.monotone_inverse = true});
}

const Names kHard{"normals finite", "length - 1", "below the horizon", "pdf finite, not negative",
                  "facing away / (1 + alpha mu)"};
const Names kInverse{"u-error of slope x",
                     "u-error of slope x, tails",
                     "u-error of slope y",
                     "u-error of slope y, tails",
                     "tail mass / 2^-20 - 1, slope x",
                     "tail mass / 2^-20 - 1, slope y",
                     "steps back (monotone)",
                     "jumps (continuous)"};
const Names kDensity{"integral of pdf - 1", "pdf of sampled normals", "D", "Lambda", "G1"};
const Names kFurnace{"projected area - 1", "weak white furnace - 1", "reciprocity of G2",
                     "energy of a mirror over 1", "energy of glass over 1"};
const Names kQuasiRandom{"radius, distance of cdfs", "azimuth, distance of cdfs",
                         "slope x, distance of cdfs"};
const Names kDistribution{"radius cdf",       "radius chi-square",  "radius tails",
                          "azimuth cdf",      "azimuth chi-square", "azimuth tails",
                          "slope x cdf",      "slope x chi-square", "slope x tails",
                          "sphere chi-square"};

using Checks = std::map<std::string, Names>;

/// `names` without `left_out`.
Names without(Names names, const std::string& left_out) {
  names.erase(left_out);
  return names;
}

Checks checks_of_any() {
  return {{"hard cases", kHard},
          {"density", kDensity},
          {"furnace", kFurnace},
          {"quasi-random", kQuasiRandom},
          {"distribution", kDistribution}};
}

Checks checks_of_inverse() {
  Checks checks = checks_of_any();
  checks["density"].insert("pdf times |Jacobian| - 1");
  checks["inverse"] = kInverse;
  checks["cross-check"] = {"difference in u"};
  return checks;
}

/// A sampler that draws from below the surface too has bounds of its own there.
Checks checks_of_tables() {
  Checks checks = checks_of_inverse();
  const auto add_below = [&](const std::string& check, const Names& names) {
    for (const std::string& name : names) checks[check].insert(name + ", below");
  };
  add_below("inverse", kInverse);
  add_below("density", {"pdf times |Jacobian| - 1"});
  add_below("quasi-random", kQuasiRandom);
  add_below("cross-check", {"difference in u"});
  return checks;
}

/// Checks that the run has exactly the results of `expected`, each with a finite bound, and that it
/// tells everything else that an inverse has.
void check_made(const SamplerUnderTest& sampler, const Checks& expected) {
  const Verdict v = validate_sampler(sampler, {.thoroughness = Thoroughness::quick, .seed = 11});
  CAPTURE(sampler.name);
  Checks made, told;
  for (const CheckResult& f : v.results) {
    made[f.check].insert(f.statistic);
    CAPTURE(f.check, f.statistic, f.bound);
    CHECK(std::isfinite(f.bound));
    CHECK((f.bound < 0.2 || sampler.bounds.tail_error == f.bound ||
           sampler.bounds_below.tail_error == f.bound));
    if (f.kind == Kind::probability) CHECK(f.bound > 0);
  }
  CHECK(made == expected);
  for (const SkippedCheck& s : v.skipped) {
    CHECK_FALSE(s.reason.empty());
    told[s.check].insert(s.statistic);
  }
  for (const auto& [check, statistics] : checks_of_inverse()) {
    const auto found = expected.find(check);
    for (const std::string& statistic : statistics) {
      CAPTURE(check, statistic);
      const bool in_results = found != expected.end() && found->second.contains(statistic);
      const bool in_told = told[check].contains(statistic) || told[check].contains("");
      CHECK(in_results != in_told);
    }
  }
}

CheckResult find(const std::vector<CheckResult>& results, const std::string& statistic) {
  for (const CheckResult& f : results)
    if (f.statistic == statistic) return f;
  FAIL("there is no statistic " << statistic);
  return {};
}

using Change = std::function<Vec3<double>(const Configuration&, const RandomPair&, Vec3<double>)>;

/// `sampler` with its normals changed.
SamplerUnderTest changed(SamplerUnderTest sampler, const Change& change) {
  const auto good = sampler.sample;
  sampler.sample = [good, change](const Configuration& c, std::span<const RandomPair> u,
                                  std::span<Vec3<double>> wm) {
    good(c, u, wm);
    for (std::size_t k = 0; k < u.size(); ++k) wm[k] = change(c, u[k], wm[k]);
  };
  return sampler;
}

/// `sampler` whose random numbers are moved by `error` at most.
SamplerUnderTest moved(SamplerUnderTest sampler, double error_1, double error_2) {
  const auto good = sampler.sample;
  sampler.sample = [=](const Configuration& c, std::span<const RandomPair> u,
                       std::span<Vec3<double>> wm) {
    std::vector<RandomPair> list(u.begin(), u.end());
    for (RandomPair& p : list)
      p = {p.x + error_1 * 4 * p.x * (1 - p.x), p.y + error_2 * 4 * p.y * (1 - p.y)};
    good(c, list, wm);
  };
  return sampler;
}

}  // namespace

TEST_CASE("an inverse gets all checks, and other samplers all that apply to them") {
  check_made(tables(), checks_of_tables());
  check_made(named("ggx-caps"), checks_of_any());
  Checks all = checks_of_any();
  all["hard cases"] = without(kHard, "facing away / (1 + alpha mu)");
  check_made(named("ggx-ndf"), all);
  Checks cavities = checks_of_any();
  cavities["density"] = without(kDensity, "G1");
  cavities["furnace"] = without(kFurnace, "weak white furnace - 1");
  cavities.erase("quasi-random");
  check_made(named("ggx-v-cavity"), cavities);
}

TEST_CASE("a map that tells no density has no Jacobian, and it is told") {
  SamplerUnderTest sampler = exact_inverse();
  sampler.sample_double = {};
  Checks expected = checks_of_inverse();
  expected["density"].erase("pdf times |Jacobian| - 1");
  check_made(sampler, expected);
}

TEST_CASE("a run that stops at a failure tells what it did not come to") {
  SamplerUnderTest sampler = named("ggx-caps");
  sampler.d = [](const ExactSurface&, std::span<const Vec3<double>>, std::span<double> d) {
    std::fill(d.begin(), d.end(), 0.0);
  };
  const Verdict v = validate_sampler(
      sampler, {.thoroughness = Thoroughness::quick, .stop_at_first_failure = true});
  REQUIRE_FALSE(v.passed());
  CHECK(v.results.back().check == "density");
  Names told;
  for (const SkippedCheck& s : v.skipped)
    if (s.reason == "a check before it failed") told.insert(s.check);
  CHECK(told == Names{"furnace", "quasi-random", "distribution"});
}

TEST_CASE("hard cases measure a defect of each kind") {
  const SamplerUnderTest good = exact_inverse();
  const auto measured = [&](const Change& change, const std::string& statistic) {
    return find(check_hard_cases(changed(good, change)), statistic);
  };
  const auto corner = [](const RandomPair& u) { return u.x == 1 && u.y == 0.5; };
  const CheckResult longer = measured(
      [&](const auto&, const RandomPair& u, Vec3<double> m) {
        return corner(u) ? Vec3<double>{m.x * 1.01, m.y * 1.01, m.z * 1.01} : m;
      },
      "length - 1");
  CHECK(longer.measured == Approx(0.01).epsilon(1e-3));
  CHECK(longer.where.u1 == 1);
  // A normal opposite to wi, at normal incidence and the smallest roughness: -dot / (1 + alpha mu).
  const CheckResult away = measured(
      [&](const Configuration& c, const RandomPair& u, Vec3<double> m) {
        return corner(u) && c.alpha.x == c.alpha.y && c.alpha.x < 1e-3
                   ? Vec3<double>{-c.wi.x, -c.wi.y, -c.wi.z}
                   : m;
      },
      "facing away / (1 + alpha mu)");
  CHECK(away.measured == Approx(1).epsilon(1e-3));
  CHECK_FALSE(away.passed());
  const CheckResult below = measured(
      [&](const auto&, const RandomPair& u, Vec3<double> m) {
        return corner(u) ? Vec3<double>{0.6, 0, -0.8} : m;
      },
      "below the horizon");
  CHECK(below.measured == Approx(0.8));
  const CheckResult none = measured(
      [&](const auto&, const RandomPair& u, Vec3<double> m) {
        return corner(u) ? Vec3<double>{kUnknown, 0, 1} : m;
      },
      "normals finite");
  CHECK_FALSE(none.passed());
  SamplerUnderTest negative = good;
  negative.pdf = [](const auto&, std::span<const Vec3<double>>, std::span<double> pdf) {
    std::fill(pdf.begin(), pdf.end(), -1.0);
  };
  CHECK_FALSE(find(check_hard_cases(negative), "pdf finite, not negative").passed());
}

TEST_CASE("the density check measures an error of 0.1 % of each function") {
  const auto by = [](auto function, double factor) {
    return [=](const auto& c, auto wm, auto values) {
      function(c, wm, values);
      for (double& value : values) value *= factor;
    };
  };
  const auto measured = [](const SamplerUnderTest& sampler, const std::string& statistic) {
    const CheckResult f = find(check_density(sampler, {}), statistic);
    CHECK_FALSE(f.passed());
    return f.measured;
  };
  SamplerUnderTest sampler = exact_inverse();
  sampler.pdf = by(sampler.pdf, 1.001);
  CHECK(measured(sampler, "integral of pdf - 1") == Approx(1e-3).epsilon(0.01));
  CHECK(measured(sampler, "pdf of sampled normals") == Approx(1e-3).epsilon(0.05));
  CHECK(find(check_density(sampler, {}), "pdf times |Jacobian| - 1").measured ==
        Approx(1e-3).epsilon(0.1));
  sampler = exact_inverse();
  sampler.d = by(sampler.d, 1.001);
  CHECK(measured(sampler, "D") == Approx(1e-3).epsilon(0.05));
  sampler = exact_inverse();
  sampler.g1 = [good = sampler.g1](const Configuration& c) { return 1.001 * good(c); };
  CHECK(measured(sampler, "G1") == Approx(1e-3).epsilon(0.01));
  sampler = exact_inverse();
  sampler.lambda = [good = sampler.lambda](const Configuration& c) {
    return good(c) + 1e-3 * (1 + good(c));
  };
  CHECK(measured(sampler, "Lambda") == Approx(1e-3).epsilon(0.01));
}

TEST_CASE("the map checks measure an error of 1e-4 in either random number") {
  const UErrorOptions few{.places = 60, .slopes = 3, .stride = 6};
  const auto x = moved(exact_inverse(), 1e-4, 0), y = moved(exact_inverse(), 0, 1e-4);
  CHECK(find(check_u_error(x, few), "u-error of slope x").measured == Approx(1e-4).epsilon(0.02));
  CHECK(find(check_u_error(y, few), "u-error of slope y").measured == Approx(1e-4).epsilon(0.02));
  CHECK(find(check_u_error(y, few), "u-error of slope x").passed());
  // 4 u (1 - u) 1e-4 of the mass u of a tail.
  CHECK(find(check_u_error(x, few), "tail mass / 2^-20 - 1, slope x").measured ==
        Approx(4e-4).margin(3e-4));
  // The cross-check divides by what errors in both numbers would do together, so an error in one of
  // them is told as a part of itself.
  for (const auto& sampler : {x, y}) {
    const CheckResult f = cross_check(sampler, 40, {}).front();
    CHECK(f.measured > 3e-5);
    CHECK(f.measured < 1.1e-4);
    CHECK_FALSE(f.passed());
  }
  CHECK(cross_check(exact_inverse(), 40, {}).front().passed());
}

TEST_CASE("a step back and a jump of 1e-3 are measured as such") {
  const UErrorOptions few{.places = 300, .slopes = 1, .stride = 6};
  const auto stepped = [&few](double step) {
    SamplerUnderTest sampler = exact_inverse();
    const auto good = sampler.sample;
    sampler.sample = [=](const Configuration& c, std::span<const RandomPair> u,
                         std::span<Vec3<double>> wm) {
      std::vector<RandomPair> list(u.begin(), u.end());
      for (RandomPair& p : list)
        if (p.x > 0.4 && p.x < 0.9) p.x += step;
      good(c, list, wm);
    };
    return check_u_error(sampler, few);
  };
  CHECK(find(stepped(1e-3), "jumps (continuous)").measured == Approx(1e-3).epsilon(0.01));
  CHECK_FALSE(find(stepped(-0.02), "steps back (monotone)").passed());
}

TEST_CASE("quasi-random normals show an error of 2 % in u, and counted ones 6 % and a turn") {
  const auto off = moved(named("ggx-exact"), 0.02, 0);
  const CheckResult quasi = find(check_quasi_random(off, 20000, {}), "slope x, distance of cdfs");
  CHECK(quasi.measured == Approx(0.02).epsilon(0.1));
  CHECK_FALSE(quasi.passed());
  const auto counted = check_distribution(moved(named("ggx-exact"), 0.06, 0), {.samples = 100000});
  for (const std::string statistic : {"radius cdf", "slope x cdf", "radius chi-square",
                                      "slope x chi-square", "sphere chi-square"}) {
    CAPTURE(statistic);
    CHECK_FALSE(find(counted, statistic).passed());
  }
  const auto turned =
      changed(named("ggx-exact"), [](const Configuration&, const RandomPair&, Vec3<double> m) {
        return Vec3<double>{m.x * std::cos(0.3) - m.y * std::sin(0.3),
                            m.x * std::sin(0.3) + m.y * std::cos(0.3), m.z};
      });
  const auto by_azimuth = check_distribution(turned, {.samples = 20000});
  CHECK_FALSE(find(by_azimuth, "azimuth cdf").passed());
  CHECK_FALSE(find(by_azimuth, "azimuth chi-square").passed());
}
