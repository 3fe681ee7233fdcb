// Distributions of which no table can be built are refused, each with its reason.
#include "vndf/distributions/diagnose.h"

#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "support/catch.h"
#include "vndf/distributions/families.h"
#include "vndf/distributions/family_list.h"
#include "vndf/distributions/formula_distribution.h"
#include "vndf/distributions/parse_distribution.h"
#include "vndf/precompute/unit_slopes.h"

using namespace vndf::distributions;
using namespace vndf::precompute;
using namespace vndf::test;

namespace {

class Function final : public SlopeDistribution {
 public:
  explicit Function(std::function<double(double)> f, std::vector<double> breaks = {})
      : f_(std::move(f)), breaks_(std::move(breaks)) {}
  std::string name() const override { return "function"; }
  double p22(double r) const override { return f_(r); }
  std::vector<double> breaks() const override { return breaks_; }

 private:
  std::function<double(double)> f_;
  std::vector<double> breaks_;
};

void check_refused(const SlopeDistribution& d, const std::string& why) {
  CAPTURE(why);
  CHECK_THROWS_AS(diagnose(d), std::domain_error);
  CHECK_THROWS_WITH(diagnose(d), contains("distribution '" + d.name() + "': ") && contains(why) &&
                                     !contains("\n"));
}

FormulaDistribution formula(const std::string& text) {
  return FormulaDistribution::from_p22({text, {}});
}

}  // namespace

TEST_CASE("every named family is found in order") {
  DiagnoseOptions options;
  options.singularity_at_zero_allowed = true;
  for (const auto& family : families()) {
    CAPTURE(family.name);
    if (family.make) CHECK_NOTHROW(diagnose(*parse_distribution(family.name), options));
  }
  CHECK_NOTHROW(diagnose(*parse_distribution("mixture:0.7*ggx+0.3*beckmann@0.2")));
}

TEST_CASE("formulas in order pass, overflow far out and a touching zero included") {
  CHECK_NOTHROW(diagnose(formula("exp(-r^2)")));
  CHECK_NOTHROW(diagnose(formula("r^2*exp(-r^2)")));
  CHECK_NOTHROW(diagnose(formula("(r-1)^2*exp(-r^2)")));
}

TEST_CASE("negative and undefined densities are refused with the radius") {
  check_refused(formula("(1-r)*exp(-r)"), "p22 is -");
  check_refused(formula("(1-r)*exp(-r)"),
                "at slope radius 1.01; a density must be finite and >= 0");
  check_refused(formula("sqrt(2-r)"), "at slope radius 2");
  check_refused(formula("sin(r)/r*exp(-r)"), "nan at slope radius 0; it must be >= 0 there");
  check_refused(formula("r-1"), "p22 is -1 at slope radius 0");
}

TEST_CASE("tails that reach beyond double precision are refused") {
  CHECK_THROWS_WITH(UnitSlopes(StudentT(1.51), {}),
                    contains("student-t:gamma=1.51") && contains("r^-3.03"));
  CHECK_NOTHROW(UnitSlopes(StudentT(1.52), {}));
}

TEST_CASE("infinite densities are refused at r > 0") {
  check_refused(Function([](double r) {
                  return r > 2 && r < 2.1 ? std::numeric_limits<double>::infinity() : std::exp(-r);
                }),
                "p22 is infinite at slope radius 2.01; only radius 0 may be singular");
}

TEST_CASE("a singularity at r = 0 is refused unless it is allowed") {
  const auto d = formula("exp(-r)/sqrt(r)");
  check_refused(d, "p22 is infinite at slope radius 0");
  check_refused(d, "bound it there, for example with max(r, 1e-6) in place of r");
  const auto k = parse_distribution("k:nu=1");
  check_refused(*k, "p22 is infinite at slope radius 0");
  DiagnoseOptions options;
  options.singularity_at_zero_allowed = true;
  CHECK_NOTHROW(diagnose(*k, options));
}

TEST_CASE("a gap is refused with its ends, a hole in the middle is not") {
  check_refused(Function([](double r) { return r < 1 || (r > 2 && r < 3) ? 1.0 : 0.0; }, {1, 2, 3}),
                "p22 is zero from slope radius 1 to 2 and positive on both sides");
  check_refused(*parse_distribution("mixture:1*disk@0.1+1*annulus:inner=0.5"),
                "p22 is zero from slope radius 0.1 to 0.5 and positive");
  // Narrower than the grid, but between breaks.
  check_refused(
      Function([](double r) { return r < 1 || (r > 1.001 && r < 3) ? 1.0 : 0.0; }, {1, 1.001, 3}),
      "p22 is zero from slope radius 1 to 1");
  CHECK_NOTHROW(diagnose(*parse_distribution("annulus:inner=0.9")));
}

TEST_CASE("a density that is zero everywhere is refused") {
  check_refused(Function([](double) { return 0.0; }), "p22 is zero at every slope radius");
}

TEST_CASE("a density whose mass lies beyond the radii that are tried is refused with that reason") {
  const auto refused = [](const std::string& formula, const std::string& why) {
    CHECK_THROWS_WITH(diagnose(FormulaDistribution::from_p22({formula, {}})), contains(why));
  };
  refused("exp(-(r/1e200)^2)", "does not fall up to a slope radius of 1e8");
  refused("exp(-(r/1e-200)^2)", "zero at every slope radius that was tried, from 1e-8 to 1e8");
  refused("1/(1+r^2)", "does not converge");
  CHECK_NOTHROW(diagnose(FormulaDistribution::from_p22({"exp(-(r/1e5)^2)", {}})));
}

TEST_CASE("densities without a finite integral or mean are refused") {
  check_refused(formula("1/(1+r^2)"), "does not converge");
  check_refused(formula("(1+r^2)^-1.5"), "the mean slope");
}
