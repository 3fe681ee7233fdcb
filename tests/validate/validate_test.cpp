// The validator passes exact samplers and tables, rejects every known mistake at the default
// setting, and its runs follow from their seeds.
#include "vndf/validate/validate.h"

#include <cmath>
#include <random>
#include <string>

#include "support/built_tables.h"
#include "support/catch.h"
#include "support/samplers_under_test.h"
#include "vndf/validate/checks/cross_check.h"
#include "vndf/validate/checks/density_check.h"
#include "vndf/validate/checks/distribution_check.h"
#include "vndf/validate/checks/furnace_check.h"
#include "vndf/validate/checks/hard_cases.h"
#include "vndf/validate/checks/u_error_check.h"

using namespace vndf;
using namespace vndf::validate;
using namespace vndf::test;

namespace {

SamplerUnderTest tables_of(const std::string& distribution) {
  const auto& built = small_tables(distribution);
  return tables_under_test(distribution, exact_slopes(distribution), built.tables,
                           built.certificate);
}

/// A sampler with one mistake that claims what good tables claim.
template <template <class> class Mistaken>
SamplerUnderTest mistaken(const std::string& distribution) {
  const auto& built = small_tables(distribution);
  return under_test("mistaken " + distribution, exact_slopes(distribution),
                    Mistaken<float>(built.tables), Mistaken<double>(built.tables),
                    {.monotone_inverse = true}, bounds_of(built.certificate, 96));
}

SamplerUnderTest caps() {
  return under_test("caps", exact_slopes("ggx"), CapsGgx<float>{}, CapsGgx<double>{}, Claims{});
}

SamplerUnderTest inverse_beckmann() {
  return under_test("inverse", exact_slopes("beckmann"), InverseBeckmann<float>{},
                    InverseBeckmann<double>{}, {.monotone_inverse = true});
}

/// The name of the first statistic that fails at the default setting; empty if none does.
std::string rejected_by(const SamplerUnderTest& sampler) {
  const Verdict v = validate_sampler(sampler, {.seed = 3, .stop_at_first_failure = true});
  const CheckResult* f = v.first_failure();
  return f == nullptr ? "" : f->statistic;
}

void check_passes(const SamplerUnderTest& sampler, const ValidationOptions& options) {
  const Verdict v = validate_sampler(sampler, options);
  CAPTURE(sampler.name, options.seed);
  for (const CheckResult& f : v.results) {
    CAPTURE(f.check, f.statistic, f.measured, f.bound, f.where.theta, f.where.u1, f.where.u2);
    CHECK(f.passed());
  }
}

ValidationOptions quick(std::uint64_t seed) {
  return {.thoroughness = Thoroughness::quick, .seed = seed};
}

/// The exact map of any distribution, of which only the normals are checked.
SamplerUnderTest exact_map(const std::string& distribution) {
  SamplerUnderTest sampler;
  sampler.name = distribution;
  sampler.exact = exact_slopes(distribution);
  sampler.claims.monotone_inverse = true;
  sampler.sample = [slopes = sampler.exact](const Configuration& c, std::span<const RandomPair> u,
                                            std::span<Vec3<double>> wm) {
    for (std::size_t k = 0; k < u.size(); ++k) wm[k] = exact_normal(*slopes, c, u[k].x, u[k].y);
  };
  return sampler;
}

/// `sampler` with its random numbers u1 moved by up to `error`, most for u1 in the middle.
SamplerUnderTest disturbed(SamplerUnderTest sampler, double error) {
  const auto good = sampler.sample;
  sampler.sample = [good, error](const Configuration& c, std::span<const RandomPair> u,
                                 std::span<Vec3<double>> wm) {
    std::vector<RandomPair> moved(u.begin(), u.end());
    for (RandomPair& p : moved) p.x += error * 4 * p.x * (1 - p.x);
    good(c, moved, wm);
  };
  return sampler;
}

}  // namespace

TEST_CASE("an exact sampler whose map is not monotone passes, with several seeds") {
  check_passes(caps(), quick(1));
  for (const std::uint64_t seed : {2u, 3u, 4u})
    CHECK(all_passed(check_distribution(caps(), {.samples = 50000, .seed = seed})));
}

TEST_CASE("an exact monotone map passes") {
  const SamplerUnderTest exact = inverse_beckmann();
  CHECK(all_passed(check_hard_cases(exact)));
  CHECK(all_passed(check_u_error(exact, {.places = 150, .slopes = 2, .stride = 2})));
  CHECK(all_passed(check_density(exact, {})));
  CHECK(all_passed(check_furnace(exact, {})));
  CHECK(all_passed(cross_check(exact, 20, {})));
  CHECK(all_passed(check_distribution(exact, {.samples = 10000})));
}

TEST_CASE("tables pass within their own certificate: heavy and compact distributions") {
  for (const std::string name : {"student-t:gamma=1.55", "disk"})
    check_passes(tables_of(name), quick(5));
}

TEST_CASE("tables of a heavy tail stay within the edge of visibility at u1 = 1") {
  // The slopes of Student-T 1.6 at alpha 1e-4 and the edge differ in their last digits only.
  for (const CheckResult& f : check_hard_cases(tables_of("student-t:gamma=1.6"))) {
    CAPTURE(f.statistic, f.measured, f.where.theta, f.where.alpha_x, f.where.u1);
    CHECK(f.passed());
  }
}

TEST_CASE("mistake: alpha_x is used for alpha_y") {
  CHECK(rejected_by(mistaken<AlphaXForAlphaY>("ggx")) != "");
}

TEST_CASE("mistake: G1 is missing from the pdf") {
  const SamplerUnderTest sampler = mistaken<PdfWithoutG1>("beckmann");
  CHECK(rejected_by(sampler) != "");
  CHECK_FALSE(check_density(sampler, {}).front().passed());  // the integral of the pdf
}

TEST_CASE("mistake: 2 / pi for 2 pi on one branch") {
  const SamplerUnderTest broken =
      under_test<float>("broken", exact_slopes("ggx"), CapsGgx<float, BrokenTurn>{}, Claims{});
  CHECK(rejected_by(broken) != "");
}

TEST_CASE("the counting check alone rejects 2 / pi for 2 pi and alpha_x for alpha_y") {
  const DistributionCheckOptions options{.samples = 200000, .stop_at_first_failure = true};
  const SamplerUnderTest broken =
      under_test<float>("broken", exact_slopes("ggx"), CapsGgx<float, BrokenTurn>{}, Claims{});
  CHECK_FALSE(all_passed(check_distribution(broken, options)));
  CHECK_FALSE(all_passed(check_distribution(mistaken<AlphaXForAlphaY>("ggx"), options)));
  CHECK(all_passed(check_distribution(caps(), options)));
}

TEST_CASE("mistake: table rows are shifted by half a cell") {
  auto sampler = tables_of("ggx");
  const auto& built = small_tables("ggx");
  const double half = 0.5 / static_cast<double>(built.tables->marginal.rows() - 1);
  const auto shifted = with_rows_at(*built.tables, [half](double row) { return row + half; });
  CHECK(rejected_by(tables_under_test("shifted", sampler.exact, shifted, built.certificate)) ==
        "u-error of slope x");
}

TEST_CASE("mistake: the row index is scaled by n instead of n - 1") {
  const auto& built = small_tables("beckmann");
  const double n = static_cast<double>(built.tables->marginal.rows());
  const auto scaled =
      with_rows_at(*built.tables, [n](double row) { return std::min(1.0, row * n / (n - 1)); });
  CHECK(rejected_by(tables_under_test("scaled", exact_slopes("beckmann"), scaled,
                                      built.certificate)) == "u-error of slope x");
}

TEST_CASE("mistake: the tail is cut at slope 16") {
  CHECK(rejected_by(mistaken<TailCut>("ggx")) != "");
}

TEST_CASE("mistake: Lambda is 0.3 % too large") {
  const std::string statistic = rejected_by(mistaken<LambdaOff>("beckmann"));
  CHECK((statistic == "Lambda" || statistic == "integral of pdf - 1"));
}

TEST_CASE("the u-error that the validator measures is the certificate's, by another path") {
  // One from sampled normals and the validator's angles, the other from table lookups between the
  // rows.
  const auto& built = small_tables("ggx");
  const auto results = check_u_error(tables_of("ggx"), {.stride = 2});
  const double certified =
      std::max(built.certificate.marginal.max_u_error, built.certificate.conditional.max_u_error);
  CHECK(results[0].measured > certified / 4);
  CHECK(results[0].measured < certified * 1.25);
}

TEST_CASE("an error of 1e-4 in u is measured as 1e-4") {
  const SamplerUnderTest off = disturbed(inverse_beckmann(), 1e-4);
  const auto results = check_u_error(off, {.places = 100, .slopes = 1, .stride = 4});
  CHECK(results[0].statistic == "u-error of slope x");
  CHECK(results[0].measured == Approx(1e-4).epsilon(0.01));
  CHECK(results[2].measured < 1e-6);
}

TEST_CASE("the bounds of tables are their certificate's, without a bound where it gives none") {
  Certificate c;
  c.marginal.max_u_error = 1e-4;
  c.conditional.lower.e6 = 0.5;
  CHECK(bounds_of(c, 64).u_error == Approx(1.25e-4).epsilon(0.01));
  CHECK(bounds_of(c, 64).tail_error == Approx(1.25 + 0.05));
  c.conditional.lower.e6 = 0.125;
  CHECK(std::isinf(bounds_of(c, 64).tail_error));
}

TEST_CASE("a run follows from its seed, whatever the number of threads") {
  const DistributionCheckOptions one{.samples = 70000, .seed = 9, .workers = {1}};
  DistributionCheckOptions two = one, other = one;
  two.workers = {2};
  other.seed = 10;
  const auto values = [](const DistributionCheckOptions& options) {
    std::vector<double> list;
    for (const CheckResult& f : check_distribution(caps(), options)) list.push_back(f.measured);
    return list;
  };
  const auto first = values(one);
  CHECK(values(two) == first);
  CHECK(values(other) != first);
}

TEST_CASE("the exact normal of the cross-validation inverts the exact transform") {
  const auto slopes = exact_slopes("ggx");
  const Configuration c = at_angles(50, 30, 0.4, 0.9);
  const ExactDistribution exact(*slopes, SampledNormals::visible_smith, c);
  for (const double u1 : {0.01, 0.4, 0.99})
    for (const double u2 : {0.02, 0.5, 0.7}) {
      const Vec3<double> wm = exact_normal(*slopes, c, u1, u2);
      const StretchedSlope s = exact.frame().slope_of(wm);
      CHECK(exact.uniforms(wm, 0).x == Approx(u1).epsilon(1e-9));
      CHECK(GgxForms::conditional(s.x / s.w, s.y / s.w) == Approx(u2).epsilon(1e-9));
    }
}

TEST_CASE("beside an exact sampler a difference counts as the error in u that makes it") {
  // The radius of Student-T 1.55 moves by five times the error of a slope in its tail, that of a
  // ring by four times.
  for (const std::string name : {"student-t:gamma=1.55", "annulus:inner=0.5"}) {
    SamplerUnderTest exact = exact_map(name);
    exact.bounds.u_error = 1e-5;
    const CheckResult own = cross_check(exact, 100, {}).front();
    const CheckResult half = cross_check(disturbed(exact, 5e-6), 100, {}).front();
    CAPTURE(name, own.measured, half.measured);
    CHECK(own.measured < 1e-10);
    CHECK(half.measured == Approx(5e-6).epsilon(0.1));
    CHECK_FALSE(cross_check(disturbed(exact, 2e-5), 100, {}).front().passed());
  }
}

TEST_CASE("tables of every kind of distribution pass the default setting", "[.slow]") {
  for (const std::string name :
       {"ggx", "beckmann", "student-t:gamma=1.55", "disk", "annulus", "k", "volcano",
        "exponential-power:p=0.5", "exponential-power:p=8", "mixture:0.7*ggx+0.3*beckmann@0.2"})
    check_passes(tables_of(name), {.seed = std::random_device{}()});
}

TEST_CASE("exact samplers pass in 20 of 20 fresh seeds, one of them at the default setting",
          "[.slow]") {
  std::random_device fresh;
  for (int run = 0; run < 20; ++run) {
    check_passes(caps(), {.seed = fresh()});
    check_passes(inverse_beckmann(), quick(fresh()));
  }
}
