// Tables of every family: what the certificate finds, and families that are each other's.
#include <cmath>
#include <string>
#include <vector>

#include "support/built_tables.h"
#include "support/catch.h"
#include "support/tolerances.h"
#include "vndf/distributions/family_list.h"
#include "vndf/distributions/formula_distribution.h"
#include "vndf/distributions/parse_distribution.h"
#include "vndf/precompute/build_tables.h"
#include "vndf/precompute/measure_certificate.h"
#include "vndf/support/text.h"

using namespace vndf;
using namespace vndf::distributions;
using namespace vndf::precompute;
using namespace vndf::test;

namespace {

struct Bound {
  std::string spec;
  double marginal = kFamilyUError, conditional = kFamilyUError;
  double tail = kTailRatioAt1e6;
  double below = kFamilyUError;
};

/// Of Student-T slopes at gamma = 1.55 a mass of 2.7e-5 lies beyond the largest float: there all
/// slopes are one and tail masses have no meaning. The certificate ends at a ratio of 8.
constexpr double kBeyondFloat = 7;

/// Below the horizon the slopes that are seen of a bounded distribution or a light tail differ by
/// little, down to a part of 1e-5 of themselves where 1e-12 of the surface is visible, and single
/// precision rounds them by 1e-7 of themselves. The next test has the bound without rounding.
constexpr double kRoundedAtRim = 1e-3, kRoundedInTail = 5e-5, kHorizontal = 2e-4;

/// The bound for all, and the measured ones of the cases that miss it, whose reasons the README
/// gives.
const std::vector<Bound> kBounds{
    {"student-t:gamma=1.55", 3e-5, kFamilyUError, kBeyondFloat, kHorizontal},
    {"student-t:gamma=1.6"},
    {"student-t:gamma=20"},
    {"exponential-power:p=0.5"},
    {"exponential-power:p=16", kFamilyUError, kFamilyUError, kTailRatioAt1e6, kRoundedInTail},
    {"disk", kFamilyUError, kFamilyUError, kTailRatioAt1e6, kRoundedAtRim},
    {"annulus:inner=0.5", kFamilyUError, kFamilyUError, 0.1, kRoundedAtRim},
    {"k:nu=1"},
    {"hyper-cauchy:q=1.75"},
    {"mixture:0.7*ggx+0.3*beckmann@0.33"},
    {"mixture:0.5*ggx+0.5*beckmann@0.01", 1.5e-5, 8e-5}};

void check_ratios(const TailRatios& ratios, double bound) {
  CHECK(std::abs(ratios.e6 - 1) <= bound);
  CHECK(std::abs(ratios.e5 - 1) <= bound);
}

/// Certificate of `tables` measured as those of `spec`.
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
    CHECK(c.marginal.max_u_error <= b.marginal);
    CHECK(c.conditional.max_u_error <= b.conditional);
    CHECK(c.below.max_u_error <= b.below);
    check_ratios(c.marginal.lower, b.tail);
    check_ratios(c.marginal.upper, b.tail);
    check_ratios(c.conditional.lower, b.tail);
    check_ratios(c.conditional.upper, b.tail);
  }
}

TEST_CASE("in double precision rows below the horizon keep 5e-6 to a visible part of 1e-12") {
  for (const std::string spec : {"beckmann", "exponential-power:p=16", "disk"}) {
    const auto d = parse_distribution(spec);
    const auto built = build_tables(*d, {.layout = {1024, 1024, true}, .threads = 2});
    CAPTURE(spec);
    CHECK(built.certificate.below.max_u_error <= kFamilyUError);
  }
}

// Two minutes on one core.
TEST_CASE("at both ends of every range the tables keep the stated u-error", "[.slow]") {
  for (const FamilyInfo& family : families())
    for (const FamilyParameter& parameter : family.accepts)
      for (const double end : {parameter.least, parameter.greatest}) {
        const std::string spec =
            family.name + ":" + parameter.name + "=" + support::number_text(end);
        const Certificate certificate = build_tables(*parse_distribution(spec)).certificate;
        CAPTURE(spec);
        CHECK(certificate.marginal.max_u_error <= kRangeUError);
        CHECK(certificate.conditional.max_u_error <= kRangeUError);
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
        REQUIRE(std::abs(ta.marginal.row(i)[j].value - tb.marginal.row(i)[j].value) < 2e-7);
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
  constexpr double kOfItsOwn = 1e-6;
  const auto same = [](const std::string& formula, const std::string& family) {
    CAPTURE(formula, family);
    const auto built = build_tables(FormulaDistribution::from_p22({formula, {}}));
    const Certificate c = as(family, *built.tables);
    const Certificate& own = large_tables(family).certificate;
    CHECK(c.marginal.max_u_error <= own.marginal.max_u_error + kOfItsOwn);
    CHECK(c.conditional.max_u_error <= own.conditional.max_u_error + kOfItsOwn);
  };
  same("exp(-r^2)/pi", "beckmann");
  same("exp(-r)", "exponential-power:p=1");
  same("r < 3 ? 1 : 0", "disk");
}

TEST_CASE("a formula with a jump inside is as good as the family, once its radius is named") {
  const auto ring =
      FormulaDistribution::from_p22({"r > 1 && r < 2 ? 1 : 0", {}}, std::vector<double>{1});
  const Certificate& family = large_tables("annulus:inner=0.5").certificate;
  const Certificate c = as("annulus:inner=0.5", *build_tables(ring).tables);
  CHECK(c.marginal.max_u_error <= family.marginal.max_u_error + 1e-6);
}

TEST_CASE("a two-scale mixture is ten times better through the map of its marginal") {
  const auto& built = large_tables("mixture:0.5*ggx+0.5*beckmann@0.01");
  // Measured without: 5.0e-4.
  CHECK(built.certificate.marginal.max_u_error < 5e-5);
}

TEST_CASE("the last row of a ring is the limit at its rim") {
  // Beyond its inner radius a ring is uniform along y: |y| / scale is the probability itself.
  const QuantileTable& table = small_tables("annulus:inner=0.95").tables->conditional;
  const auto* row = table.row(table.rows() - 1);
  for (std::size_t j = 0; j < table.columns(); ++j) {
    const double t = static_cast<double>(j) / static_cast<double>(table.columns() - 1);
    const double exact = conditional_value(bounded_from_slope(conditional_column_inverse(t).u));
    CHECK(std::abs(row[j].value - exact) <= 1e-7);
  }
}
