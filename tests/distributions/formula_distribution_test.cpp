// Formulas: what they evaluate to, from many threads too, and every error with its column.
#include "vndf/distributions/formula_distribution.h"

#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "support/catch.h"
#include "vndf/distributions/families.h"

using namespace vndf::distributions;
using namespace vndf::test;

namespace {

const std::string kGgxOfTheta = "alpha^2 / (pi * cos(theta)^4 * (alpha^2 + tan(theta)^2)^2)";
const std::string kBeckmannOfTheta = "exp(-(tan(theta)/alpha)^2) / (pi * alpha^2 * cos(theta)^4)";

double value(const std::string& text, double r = 0) {
  return FormulaDistribution::from_p22({text, {}}).p22(r);
}

void check_refused(const Formula& formula, const std::string& why, std::size_t column) {
  CAPTURE(formula.text);
  CHECK_THROWS_AS(FormulaDistribution::from_p22(formula), std::invalid_argument);
  CHECK_THROWS_WITH(
      FormulaDistribution::from_p22(formula),
      contains("formula '" + formula.text + "', column " + std::to_string(column) + ": ") &&
          contains(why) && !contains("\n"));
}

void check_parameter_refused(const Formula& formula, const std::string& why) {
  CHECK_THROWS_AS(FormulaDistribution::from_p22(formula), std::invalid_argument);
  CHECK_THROWS_WITH(FormulaDistribution::from_p22(formula), contains(why));
}

/// The message holds `why` and fits into a few lines.
void check_refused_in_short(const Formula& formula, const std::string& why) {
  try {
    FormulaDistribution::from_p22(formula);
    FAIL("it is accepted");
  } catch (const std::invalid_argument& error) {
    CHECK_THAT(error.what(), contains(why) && !contains("\n"));
    CHECK(std::string(error.what()).size() < 400);
  }
}

}  // namespace

TEST_CASE("a formula in r is the density") {
  const auto beckmann = FormulaDistribution::from_p22({"exp(-r^2)/pi", {}});
  for (const double r : {0.0, 0.3, 2.0}) CHECK(beckmann.p22(r) == Approx(Beckmann().p22(r)));
  CHECK(beckmann.name() == "p22(r) = exp(-r^2)/pi");
}

TEST_CASE("a normal distribution as a formula is costly, a slope density is not") {
  CHECK_FALSE(FormulaDistribution::from_p22({"exp(-r^2)/pi", {}}).costly());
  CHECK(FormulaDistribution::from_ndf(NdfFormula({"cos(theta)^3", {}})).costly());
}

TEST_CASE("a function of the caller's is the distribution of its formula") {
  const auto formula = FormulaDistribution::from_p22({"r < 2 ? exp(-r) : 0", {}}, {1});
  const auto function = FormulaDistribution::from_function(
      "mine", [](double r) { return r < 2 ? std::exp(-r) : 0; }, {1});
  CHECK(function.name() == "mine");
  CHECK(function.support() == formula.support());
  CHECK(function.breaks() == formula.breaks());
  CHECK_FALSE(function.costly());
  for (const double r : {0.0, 0.5, 1.0, 1.999, 2.0, 3.0}) CHECK(function.p22(r) == formula.p22(r));
}

TEST_CASE("the usual functions and constants are known") {
  CHECK(value("pi") == std::numbers::pi);
  CHECK(value("e") == std::numbers::e);
  CHECK(value("2e-1*r + 1.5E+1", 10) == 17);
  CHECK(value("pow(r, 3) + r^2", 2) == 12);
  CHECK(value("ln(e^2) + log(e) + log2(8) + log10(100)") == Approx(8));
  CHECK(value("abs(-1) + sqrt(4) + max(1, 5) + min(2, 3) + sign(-3)") == Approx(9));
  CHECK(value("sin(r)^2 + cos(r)^2 + tan(0) + cosh(0) + sinh(0) + tanh(0)", 0.7) == Approx(2));
  CHECK(value("atan(1) + atan2(1, 1) + acos(1) + asin(0)") == Approx(std::numbers::pi / 2));
  CHECK(value("r < 1 && r >= 0 ? 3 : 4", 0.5) == 3);
  CHECK(value("r == 1 || r > 2 ? 3 : 4", 1.5) == 4);
  CHECK(value("-r^2", 3) == -9);
}

TEST_CASE("parameters are numbers by name, shown in the name of the distribution") {
  const auto d = FormulaDistribution::from_p22({"a*exp(-b_2*r)", {{"a", 3}, {"b_2", 0.5}}});
  CHECK(d.p22(2) == Approx(3 * std::exp(-1)));
  CHECK(d.name() == "p22(r) = a*exp(-b_2*r), a=3, b_2=0.5");
}

TEST_CASE("a formula in theta is D, frozen at one alpha") {
  const NdfFormula ggx({kGgxOfTheta, {}});
  CHECK(ggx.uses_alpha());
  CHECK(ggx(0, 0.5) == Approx(4 / std::numbers::pi));
  const auto unit = FormulaDistribution::from_ndf(ggx);
  const auto frozen = FormulaDistribution::from_ndf(ggx, 0.25);
  for (const double r : {0.0, 0.1, 1.0, 30.0}) {
    CHECK(unit.p22(r) == Approx(Ggx().p22(r)).epsilon(1e-14));
    CHECK(frozen.p22(r) == Approx(16 * Ggx().p22(4 * r)).epsilon(1e-14));
  }
  CHECK(frozen.name() == "D(theta) = " + kGgxOfTheta + ", alpha=0.25");
}

TEST_CASE("a formula that is 0 beyond some radius is compact, and the radius is found") {
  const auto disk = FormulaDistribution::from_p22({"r < 2.5 ? 1 : 0", {}});
  CHECK(disk.support() == Approx(2.5).epsilon(1e-15));
  CHECK(disk.breaks() == std::vector<double>{disk.support()});
  const auto cone = FormulaDistribution::from_p22({"r < 0.3 ? 0.3 - r : 0", {}});
  CHECK(cone.support() == Approx(0.3).epsilon(1e-12));
  const auto ndf = FormulaDistribution::from_ndf(NdfFormula({"theta < 0.5 ? 1 : 0", {}}));
  CHECK(ndf.support() == Approx(std::tan(0.5)).epsilon(1e-12));
}

TEST_CASE("a formula that sinks below the smallest number has no end") {
  for (const std::string text : {"exp(-r^2)", "exp(-r)", "exp(-r^16)", "(1+r^2)^(-2)"}) {
    CAPTURE(text);
    const auto d = FormulaDistribution::from_p22({text, {}});
    CHECK(std::isinf(d.support()));
    CHECK(d.breaks().empty());
  }
}

TEST_CASE("breaks of a formula are sorted, and those beyond its end dropped") {
  const auto d = FormulaDistribution::from_p22({"r < 1 ? 2 : r < 3 ? 1 : 0", {}}, {5, 1, 1});
  REQUIRE(d.breaks().size() == 2);
  CHECK(d.breaks()[0] == 1);
  CHECK(d.breaks()[1] == Approx(3).epsilon(1e-15));
  for (const double bad : {0.0, -1.0, std::numeric_limits<double>::infinity()})
    CHECK_THROWS_WITH(FormulaDistribution::from_p22({"exp(-r)", {}}, {bad}),
                      contains("break") && contains("must be a number from 1e-08"));
}

TEST_CASE("a D of theta alone needs no alpha") {
  const NdfFormula phong({"(n+2)/(2*pi)*cos(theta)^n", {{"n", 50}}});
  CHECK_FALSE(phong.uses_alpha());
  const auto d = FormulaDistribution::from_ndf(phong);
  for (const double r : {0.0, 0.1, 1.0, 100.0})
    CHECK(d.p22(r) == Approx(BlinnPhong(50).p22(r)).epsilon(1e-13));
  CHECK(d.name() == "D(theta) = (n+2)/(2*pi)*cos(theta)^n, n=50");
}

TEST_CASE("D keeps its precision at grazing normals, where theta no longer tells the slope") {
  const auto d = FormulaDistribution::from_ndf(NdfFormula({kGgxOfTheta, {}}));
  for (const double r : {1e6, 1e10, 1e15, 1e18, 1e30})
    CHECK(d.p22(r) == Approx(Ggx().p22(r)).epsilon(1e-13));
}

TEST_CASE("far out, arithmetic that overflows counts as density 0") {
  CHECK(value("r^2*exp(-r^2)", 1e200) == 0);
  const auto beckmann = FormulaDistribution::from_ndf(NdfFormula({kBeckmannOfTheta, {}}));
  for (const double r : {1e30, 1e80, 1e100, 1e300}) CHECK(beckmann.p22(r) == 0);
  CHECK(std::isnan(value("sqrt(2-r)", 3)));
}

TEST_CASE("any number of threads may evaluate, and formulas may come and go") {
  const auto d = FormulaDistribution::from_p22({"a*exp(-r)+sin(r)^2", {{"a", 2}}});
  std::vector<std::thread> threads;
  std::vector<int> wrong(4);
  for (std::size_t t = 0; t < wrong.size(); ++t)
    threads.emplace_back([&, t] {
      for (int i = 0; i < 2000; ++i) {
        const double r = 0.001 * i + static_cast<double>(t);
        const double exact = 2 * std::exp(-r) + std::sin(r) * std::sin(r);
        if (std::abs(d.p22(r) - exact) > 1e-14) ++wrong[t];
        if (i % 100 == 0 && value("r+" + std::to_string(i), r) != r + i) ++wrong[t];
      }
    });
  for (auto& thread : threads) thread.join();
  CHECK(wrong == std::vector<int>{0, 0, 0, 0});
}

TEST_CASE("copies evaluate after the original is gone") {
  auto first = std::make_unique<FormulaDistribution>(FormulaDistribution::from_p22({"r+1", {}}));
  const FormulaDistribution copy = *first;
  first.reset();
  CHECK(copy.p22(2) == 3);
}

TEST_CASE("unknown names are refused with the nearest known one") {
  check_refused({"exp(-rr^2)", {}}, "nothing is called 'rr'; did you mean 'r'? known: r, pi, e", 6);
  check_refused({"exp(-widht*r)", {{"width", 2}}}, "'widht'; did you mean 'width'?", 6);
  check_refused({"1/(1+theta^2)", {}}, "nothing is called 'theta'; known: r, pi, e", 6);
  check_refused({"1 + sqr(r)", {}}, "there is no function 'sqr'; did you mean 'sqrt'?", 5);
  check_refused({"gamma(r)", {}}, "there is no function 'gamma'; known: abs, acos", 1);
  check_refused({"sin r", {}}, "function 'sin' needs '(' after it", 1);
}

TEST_CASE("broken formulas are refused where they break") {
  check_refused({"", {}}, "the formula is empty", 1);
  check_refused({"   ", {}}, "the formula is empty", 1);
  check_refused({"exp(-r^2", {}}, "a ')' is missing", 9);
  check_refused({"exp(-r^2))", {}}, "unexpected ')'", 10);
  check_refused({"exp(-r)+", {}}, "the formula ends where a value is expected", 9);
  check_refused({"*r", {}}, "a value is expected in place of the operator '*'", 1);
  check_refused({"r**2", {}}, "a value is expected in place of the operator '*'", 3);
  check_refused({"2r", {}}, "an operator is expected before 'r'", 2);
  check_refused({"r 2", {}}, "an operator is expected before '2'", 3);
  check_refused({"r(2)", {}}, "unexpected '('", 2);
  check_refused({"exp(r,2)", {}}, "too many arguments for 'exp'", 8);
  check_refused({"exp()", {}}, "too few arguments for 'exp'", 5);
  check_refused({"r, 2", {}}, "',' belongs between the arguments of a function", 2);
  check_refused({"r < 1 ? 1", {}}, "'?' without ':'", 10);
  check_refused({"1 : 2", {}}, "':' without '?'", 4);
  check_refused({"r $ 2", {}}, "cannot read '$ 2", 3);
  check_refused({"r = 2", {}}, "'=' would assign; '==' compares", 3);
  check_refused({"\"r\"", {}}, "unexpected 'r'", 4);
}

TEST_CASE("formulas beyond the limits are refused at once, and one at the limits is not") {
  const auto nested = [](std::size_t depth) {
    return std::string(depth, '(') + "exp(-r)" + std::string(depth, ')');
  };
  CHECK(FormulaDistribution::from_p22({nested(63), {}}).p22(0) == 1);
  check_refused_in_short({nested(64), {}}, "column 68: more than 64 parentheses are open");
  check_refused_in_short({std::string(1000000, '('), {}}, "goes on beyond 2000 characters");
  std::string sum = "exp(-r)";
  while (sum.size() + 2 <= 2000) sum += "+0";
  CHECK(FormulaDistribution::from_p22({sum, {}}).p22(0) == 1);
  check_refused_in_short({sum + "+0", {}}, "column 2001: the formula goes on beyond 2000");
  std::map<std::string, double> many;
  std::string products = "exp(-r)";
  for (int k = 0; k < 33; ++k) {
    const std::string name = std::string("k").append(std::to_string(k));
    many[name] = 1;
    products.append("*").append(name);
  }
  check_refused_in_short({products, many}, "it has 33 parameters; at most 32");
  check_refused_in_short({std::string(1990, 'x'), {}}, "nothing is called 'xxx");
  CHECK_THROWS_WITH(FormulaDistribution::from_p22({"exp(-r)", {}}, std::vector<double>(17, 1.0)),
                    contains("17 breaks; at most 16"));
}

TEST_CASE("a message shows the part of a long formula that it is about") {
  const std::string padding(500, ' ');
  check_refused_in_short({"exp(-r)" + padding + "+ rr" + padding, {}}, "+ rr");
}

TEST_CASE("parameters that cannot be meant are refused by name") {
  check_parameter_refused({"exp(-r)", {{"a", 1}}}, "parameter 'a' is not used by the formula");
  check_parameter_refused({"exp(-r)", {{"2a", 1}}}, "parameter '2a' is not a name");
  check_parameter_refused({"exp(-r)", {{"", 1}}}, "parameter '' is not a name");
  check_parameter_refused({"exp(-q*r)", {{"\x1b[2J", 1}}}, "parameter '?[2J' is not a name");
  check_parameter_refused({"exp(-q*r)", {{std::string(kMaxParameterName + 1, 'a'), 1}}},
                          "has a name of more than 32 characters");
  check_parameter_refused({"exp(-r)", {{"r", 1}}}, "'r' has the name of a variable");
  check_parameter_refused({"exp(-r)", {{"exp", 1}}}, "'exp' has the name of a function");
  check_parameter_refused({"exp(-r)*pi", {{"pi", 3}}}, "'pi' has the name of a function or a");
  check_parameter_refused({"exp(-a*r)", {{"a", std::nan("")}}}, "'a' is nan; it must be finite");
  CHECK_THROWS_WITH(NdfFormula({"alpha*theta", {{"alpha", 1}}}),
                    contains("'alpha' has the name of a variable"));
}

TEST_CASE("a roughness that is none is refused") {
  const NdfFormula ndf({kGgxOfTheta, {}});
  for (const double alpha : {0.0, -1.0, std::nan("")})
    CHECK_THROWS_WITH(FormulaDistribution::from_ndf(ndf, alpha),
                      contains("alpha of D is") && contains("must be a finite number > 0"));
}
