// Specifications: every kind gives the distribution of the original input bit for bit, and a text
// or samples outside of the rules are refused in words.
#include "vndf/distributions/specification.h"

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>

#include "support/catch.h"
#include "vndf/distributions/formula_distribution.h"
#include "vndf/distributions/mixture.h"
#include "vndf/distributions/parse_distribution.h"
#include "vndf/distributions/slope_map.h"

using namespace vndf;
using namespace vndf::distributions;
using namespace vndf::test;

namespace {

/// Checks all that a build asks a distribution for, but for the name.
void check_same_bits(const SlopeDistribution& a, const SlopeDistribution& b) {
  for (double r = 0; r < 1e9; r = 1.07 * r + 1e-4) {
    CAPTURE(r);
    REQUIRE(a.p22(r) == b.p22(r));
    const auto ma = a.marginals(r), mb = b.marginals(r);
    REQUIRE(ma.has_value() == mb.has_value());
    if (ma) REQUIRE((ma->p == mb->p && ma->q == mb->q && ma->m == mb->m));
  }
  CHECK(a.breaks() == b.breaks());
  CHECK(a.support() == b.support());
  CHECK(a.costly() == b.costly());
}

/// Checks a specification against the distribution that it was made for.
void check_specifies(const Specification& s, const std::string& text,
                     const SlopeDistribution& original) {
  CHECK(s.text == text);
  const auto made = make_distribution(s);
  CHECK(made->name() == original.name());
  check_same_bits(*made, original);
}

RadialProfile samples_of_ggx(std::size_t count, double end) {
  RadialProfile samples;
  for (std::size_t i = 0; i < count; ++i) {
    const double t = static_cast<double>(i) / static_cast<double>(count - 1);
    samples.r.push_back(end * t * t);
    samples.p22.push_back(std::pow(1 + samples.r.back() * samples.r.back(), -2) * 0.3);
  }
  return samples;
}

Specification profile_with(std::vector<double> r, std::vector<double> p22) {
  return {"profile", std::move(r), std::move(p22)};
}

void check_refused(const Specification& s, const std::string& why) {
  CAPTURE(s.text);
  CHECK_THROWS_AS(make_distribution(s), std::invalid_argument);
  CHECK_THROWS_WITH(make_distribution(s), contains(why) && !contains("\n"));
}

}  // namespace

TEST_CASE("families and mixtures are specified with every parameter") {
  check_specifies(specify_family("ggx"), "ggx", *parse_distribution("ggx"));
  check_specifies(specify_family("student-t"), "student-t:gamma=2.5",
                  *parse_distribution("student-t"));
  check_specifies(specify_family("k:nu=0.5"), "k:nu=0.5", *parse_distribution("k:nu=0.5"));
  const std::string mixture = "mixture:0.7*ggx+0.3*beckmann@0.1";
  check_specifies(specify_family("mixture: 7e-1 * ggx + 0.3*beckmann@0.1"), mixture,
                  *parse_distribution(mixture));
}

TEST_CASE("a distribution under another name is the same bit for bit") {
  for (const std::string family : {"ggx", "annulus:inner=0.3", "k:nu=0.5",
                                   "exponential-power:p=0.7", "mixture:0.7*ggx+0.3*disk@0.2"}) {
    CAPTURE(family);
    const Specification s = specify_family(family, "it's mine: α");
    CHECK(s.text == family + " name:'it''s mine: α'");
    const auto made = make_distribution(s);
    CHECK(made->name() == "it's mine: α");
    check_same_bits(*made, *parse_distribution(family));
  }
}

TEST_CASE("formulas are specified with their parameters and breaks") {
  const Formula smooth{"exp(-k*r^2) + 0*j", {{"k", 0.1 + 0.2}, {"j", -3e-300}}};
  check_specifies(specify_p22(smooth),
                  "p22:'exp(-k*r^2) + 0*j' param:j=-3e-300 param:k=0.30000000000000004",
                  FormulaDistribution::from_p22(smooth));
  const Formula jumps{"r < 1 ? 1 : (r < b ? exp(-r) : 0)", {{"b", 3}}};
  check_specifies(specify_p22(jumps, {1, 3}),
                  "p22:'r < 1 ? 1 : (r < b ? exp(-r) : 0)' param:b=3 break:1 break:3",
                  FormulaDistribution::from_p22(jumps, {1, 3}));
  const auto named = make_distribution(specify_p22(smooth, {}, "mine"));
  CHECK(named->name() == "mine");
  check_same_bits(*named, FormulaDistribution::from_p22(smooth));
}

TEST_CASE("normal distributions are specified with the alpha at which they are frozen") {
  const Formula invariant{"alpha^2/(cos(theta)^2*(alpha^2-1)+1)^2", {}};
  check_specifies(specify_ndf(invariant), "ndf:'alpha^2/(cos(theta)^2*(alpha^2-1)+1)^2'",
                  FormulaDistribution::from_ndf(NdfFormula(invariant)));
  const Formula blinn{"cos(theta)^(2/alpha^2-2)", {}};
  check_specifies(specify_ndf(blinn, 0.3), "ndf:'cos(theta)^(2/alpha^2-2)' frozen-at:0.3",
                  FormulaDistribution::from_ndf(NdfFormula(blinn), 0.3));
  CHECK_THROWS_AS(make_distribution(specify_ndf(blinn)), std::domain_error);
  CHECK_THROWS_WITH(specify_ndf({"cos(theta)", {}}, 0.3), contains("does not use alpha"));
}

TEST_CASE("profiles are specified by their samples and the fitted tail") {
  const RadialProfile samples = samples_of_ggx(80, 7);
  const MeasuredProfile power("a b", samples, ProfileTail::power);
  const Specification s = specify_profile(power);
  CHECK_THAT(s.text, contains("profile tail:power=3.9") && contains(" name:'a b'"));
  check_specifies(s, s.text, power);
  const MeasuredProfile exponential("e", samples, ProfileTail::exponential);
  const Specification e = specify_profile(exponential);
  CHECK_THAT(e.text, contains("profile tail:exponential="));
  check_specifies(e, e.text, exponential);
  RadialProfile ends = samples;
  for (std::size_t i = 70; i < 80; ++i) ends.p22[i] = 0;
  const MeasuredProfile compact("c", ends, ProfileTail::none);
  check_specifies(specify_profile(compact), "profile name:'c'", compact);
  CHECK(specify_profile(compact).r.size() == 71);
}

TEST_CASE("a tail without its parameter is fitted, to the same bits") {
  const RadialProfile samples = samples_of_ggx(80, 7);
  const MeasuredProfile power("", samples, ProfileTail::power);
  check_same_bits(*make_distribution({"profile tail:power", samples.r, samples.p22}), power);
}

TEST_CASE("the estimate of a slope map is specified as a profile") {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  std::vector<Vec2<double>> slopes(20000);
  for (auto& s : slopes) s = {0.2 * normal(random), 0.3 * normal(random)};
  const auto estimate = estimate_slope_map(slopes, {.name = "map"});
  const Specification s = specify_profile(*estimate.distribution);
  check_specifies(s, s.text, *estimate.distribution);
}

TEST_CASE("a text outside of the grammar is refused with its column") {
  check_refused({""}, "is empty");
  check_refused({"gxx"}, "'gxx'");
  check_refused({"ggx name:mine"}, "a text in single quotes is missing (column 10");
  check_refused({"ggx name:'mine"}, "the quote at the end of a text is missing");
  check_refused({"ggx name:'a'b"}, "a space is missing (column 13");
  check_refused({"ggx name:'a' name:'b'"}, "'name' is given twice");
  check_refused({"ggx name:'a' break:1"}, "'break' is unknown here; known: name");
  check_refused({"p22:'exp(-r)' tail:none"}, "'tail' is unknown here; known: param, break, name");
  check_refused({"p22:'exp(-r)' break"}, "has no ':'");
  check_refused({"p22:'exp(-r)' break:x"}, "'x' is not a finite number");
  check_refused({"p22:'exp(-r)' break:-1"}, "must be a number from 1e-08 to 1e+08");
  check_refused({"p22:'exp(-r)' break:1e300"}, "1e+300 must be a number from");
  check_refused({"p22:'exp(-k*r)' param:k"}, "not NAME=NUMBER");
  check_refused({"p22:'exp(-k*r)' param:k=1 param:k=2"}, "'k' is given twice");
  check_refused({"p22:'exp(-k*r)' param:k=inf"}, "'inf' is not a finite number");
  check_refused({"p22:'exp(-r'"}, "column");
  check_refused({"p22:'exp(-r)' frozen-at:1"}, "'frozen-at' is unknown here");
  check_refused({"ndf:'cos(theta)' frozen-at:0.5"}, "does not use alpha");
  check_refused({"ndf:'cos(theta)^alpha' frozen-at:0"}, "must be a finite number > 0");
  check_refused({"ggx\n"}, "a control character");
  check_refused({std::string("ggx\0", 4)}, "a control character");
  CHECK_THROWS_WITH(specify_family("ggx", "two\nlines"), contains("control character"));
  const std::string name(201, 'n');
  check_refused({"ggx name:'" + name + "'"}, "has 201 characters; at most 200");
  CHECK_THROWS_WITH(specify_family("ggx", name), contains("has 201 characters; at most 200"));
  CHECK(make_distribution(specify_family("ggx", name.substr(1)))->name() == name.substr(1));
}

TEST_CASE("a specification whose samples are no profile is refused") {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  check_refused({"ggx", {0, 1}, {1, 0}}, "belong to a profile only");
  check_refused({"profile tail:linear", {0, 1, 2, 3}, {1, 1, 1, 0}}, "none, exponential or power");
  check_refused(profile_with({}, {}), "at least 4 samples");
  check_refused(profile_with({0, 1, 2, 3}, {1, 1, 1}), "as many radii as densities");
  check_refused(profile_with({0, 1, 2, kNan}, {1, 1, 1, 0}), "radii and densities must be finite");
  check_refused(profile_with({0, 2, 1, 3}, {1, 1, 1, 0}), "radii must increase");
  check_refused(profile_with({0, 1, 2, 3}, {1, kNan, 1, 0}), "radii and densities must be finite");
}
