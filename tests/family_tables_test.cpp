// Tables of every family: what the certificate finds, and families that are each other's.
#include <cmath>
#include <string>
#include <vector>

#include "built_tables.h"
#include "catch.h"
#include "precompute/distribution_spec.h"
#include "precompute/formula_distribution.h"
#include "precompute/measure_certificate.h"
#include "tolerances.h"

using namespace vndf;
using namespace vndf::precompute;
using namespace vndf::test;

namespace {

struct Bound {
  std::string spec;
  double u_error = kFamilyUError;
  double tail = kTailRatioAt1e6;
};

/// The bound for all, and the measured ones of the cases that miss it, whose reasons the README
/// gives.
const std::vector<Bound> kBounds{{"student-t:gamma=1.55", 1e-5, 0.13},
                                 {"student-t:gamma=1.6"},
                                 {"student-t:gamma=20"},
                                 {"exponential-power:p=0.5"},
                                 {"exponential-power:p=16"},
                                 {"disk"},
                                 {"annulus:inner=0.5", 2.5e-5, 0.12},
                                 {"k:nu=1"},
                                 {"hyper-cauchy:q=1.75"},
                                 {"mixture:0.7*ggx+0.3*beckmann@0.33"},
                                 {"mixture:0.5*ggx+0.5*beckmann@0.01", 6e-4}};

void check_ratios(const TailRatios& ratios, double bound) {
  CHECK(std::abs(ratios.e6 - 1) <= bound);
  CHECK(std::abs(ratios.e5 - 1) <= bound);
}

/// u-error of `tables` judged as those of `spec`.
Certificate as(const std::string& spec, const SlopeTables& tables) {
  const auto d = parse_distribution(spec);
  const UnitSlopes slopes(*d, {});
  return measure_certificate(slopes, share(tables), {});
}

}  // namespace

TEST_CASE("1024 x 1024 tables of every family keep the README's bounds") {
  for (const Bound& b : kBounds) {
    const Certificate& c = large_tables(b.spec).certificate;
    CAPTURE(b.spec);
    CHECK(c.marginal.max_u_error <= b.u_error);
    CHECK(c.conditional.max_u_error <= b.u_error);
    check_ratios(c.marginal.lower, b.tail);
    check_ratios(c.marginal.upper, b.tail);
    check_ratios(c.conditional.lower, b.tail);
    check_ratios(c.conditional.upper, b.tail);
  }
}

TEST_CASE("families that are each other's have each other's tables") {
  const auto same = [](const std::string& a, const std::string& b) {
    CAPTURE(a, b);
    const auto& built = large_tables(a);
    const Certificate c = as(b, *built.tables);
    CHECK(c.marginal.max_u_error <= built.certificate.marginal.max_u_error + 1e-8);
    CHECK(c.conditional.max_u_error <= built.certificate.conditional.max_u_error + 1e-8);
  };
  same("student-t:gamma=2", "ggx");
  same("exponential-power:p=2", "beckmann");
  same("mixture:1*ggx@1", "ggx");
}

TEST_CASE("rescaled families have the same shape, and differ in the mean slope") {
  const auto same_shape = [](const std::string& a, const std::string& b, double ratio) {
    CAPTURE(a, b);
    const auto &ta = *small_tables(a).tables, &tb = *small_tables(b).tables;
    CHECK(ta.mean_slope / tb.mean_slope == Approx(ratio).epsilon(1e-10));
    for (std::size_t i = 0; i < ta.marginal.rows(); ++i)
      for (std::size_t j = 0; j < ta.marginal.columns(); ++j)
        REQUIRE(std::abs(ta.marginal.row(i)[j] - tb.marginal.row(i)[j]) < 2e-7f);
  };
  same_shape("hyper-cauchy:q=1.75", "student-t:gamma=1.75", std::sqrt(2 / 0.75));
  same_shape("blinn-phong:n=50", "student-t:gamma=27", std::sqrt(2.0 / 52));
}

TEST_CASE("Student-T tends to Beckmann with the first power of 1 / gamma") {
  const auto distance = [](const std::string& gamma) {
    return as("beckmann", *large_tables("student-t:gamma=" + gamma).tables).marginal.max_u_error;
  };
  const double at_1e3 = distance("1000"), at_1e4 = distance("10000");
  CHECK(at_1e3 / at_1e4 == Approx(10).epsilon(0.15));
  CHECK(at_1e4 < 1e-4);
}

TEST_CASE("a formula of a family gives the family's tables to 1e-6 in u") {
  const auto formula = FormulaDistribution::from_p22({"exp(-r^2)/pi", {}});
  const auto built = build_tables(formula);
  const Certificate c = as("beckmann", *built.tables);
  const Certificate& own = large_tables("beckmann").certificate;
  CHECK(c.marginal.max_u_error <= own.marginal.max_u_error + 1e-7);
  CHECK(c.conditional.max_u_error <= own.conditional.max_u_error + 1e-7);
}
