// The quadratures against closed forms, and what they refuse.
#include "vndf/distributions/slope_integrals.h"

#include <cmath>
#include <stdexcept>

#include "support/catch.h"
#include "support/closed_forms.h"
#include "support/tolerances.h"
#include "vndf/distributions/families.h"
#include "vndf/distributions/parse_distribution.h"

using namespace vndf::distributions;
using namespace vndf::test;

namespace {

/// A distribution from any function, for what is refused.
class Function final : public SlopeDistribution {
 public:
  explicit Function(double (*f)(double)) : f_(f) {}
  std::string name() const override { return "function"; }
  double p22(double r) const override { return f_(r); }

 private:
  double (*f_)(double);
};

void check_estimate(const Estimate& estimate, double exact) {
  CHECK(std::abs(estimate.value - exact) <= kIntegralError * exact);
  CHECK(estimate.error <= kIntegralError * exact);
}

template <class Forms>
void check_at(double x) {
  CAPTURE(x, Forms::name);
  const auto d = parse_distribution(Forms::name);
  check_estimate(marginal_density(*d, x), Forms::p(x));
  check_estimate(upper_tail(*d, x), Forms::q(x));
  check_estimate(partial_moment(*d, x), Forms::m(x));
  if (x > 0 && x < 2) check_estimate(backfacing(*d, x), x * Forms::lambda(x));
}

}  // namespace

TEST_CASE("P, Q, M and B equal the closed forms, in the tails too") {
  for (const double x : {0.0, 1e-8, 1e-3, 0.1, 0.5, 1.0, 2.0, 5.0, 15.0})
    check_at<BeckmannForms>(x);
  for (const double x : {0.0, 1e-8, 1e-3, 0.1, 1.0, 30.0, 1e4, 1e9, 1e15}) check_at<GgxForms>(x);
}

TEST_CASE("B keeps its relative precision where M - c Q has lost all of it") {
  // c Lambda(c) of GGX is 1 / (2 (c + sqrt(1 + c^2))).
  const Ggx ggx;
  for (const double c : {1e3, 1e6, 1e9})
    check_estimate(backfacing(ggx, c), 1 / (2 * (c + std::hypot(1, c))));
}

TEST_CASE("mass and mean slope of the shipped distributions") {
  const Beckmann beckmann;
  const Ggx ggx;
  check_estimate(slope_mass(beckmann), 1);
  check_estimate(slope_mass(ggx), 1);
  check_estimate(mean_slope(beckmann, 1), BeckmannForms::mean_slope());
  check_estimate(mean_slope(ggx, 1), 1);
}

TEST_CASE("a density that is negative somewhere is refused") {
  const Function d([](double r) { return (1 - r) * std::exp(-r); });
  CHECK_THROWS_WITH(slope_mass(d),
                    contains("'function'") && contains("p22 is -") && contains("at slope radius"));
}

TEST_CASE("a density that is not a number somewhere is refused") {
  const Function d([](double r) { return std::sqrt(2 - r); });
  CHECK_THROWS_WITH(slope_mass(d), contains("nan"));
}

TEST_CASE("a density that cannot be normalised is refused") {
  const Function d([](double r) { return 1 / (1 + r * r); });
  CHECK_THROWS_WITH(slope_mass(d), contains("does not converge"));
  const Function zero([](double) { return 0.0; });
  CHECK_THROWS_WITH(slope_mass(zero), contains("zero everywhere"));
}

TEST_CASE("a density with an infinite mean slope is refused") {
  // Student-T with gamma = 3/2, the first without a masking function.
  const Function d([](double r) { return std::pow(1 + 2 * r * r, -1.5) / 3.141592653589793; });
  CHECK_NOTHROW(slope_mass(d));
  CHECK_THROWS_WITH(mean_slope(d, 1), contains("mean slope"));
}
