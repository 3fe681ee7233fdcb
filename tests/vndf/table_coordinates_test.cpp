// The coordinate maps against their definitions and against their inverses.
#include "vndf/table_coordinates.h"

#include <cmath>
#include <limits>
#include <vector>

#include "support/catch.h"

using namespace vndf;
using vndf::test::Approx;

namespace {

constexpr double kRounding = 4 * std::numeric_limits<double>::epsilon();
// exp() multiplies the rounding of its argument, asinh(1e12) = 28, by that argument.
constexpr double kExpRounding = 30 * kRounding;
// sigma has absolute precision near 1/2, which the square root of a row near 0 magnifies.
constexpr double kRowRounding = 2e-8;
const std::vector<double> kSlopes{-1e12, -3.5, -1, -1e-9, 0, 1e-9, 0.25, 1, 7, 1e12};
const std::vector<double> kUnit{0, 1e-9, 1e-3, 0.1, 0.25, 0.5, 0.75, 0.9, 0.999, 1};

/// The derivative of f at x by central differences, and its error for functions as smooth as ours.
template <class F>
double difference(F f, double x) {
  constexpr double kStep = 1e-6;
  return (f(x + kStep) - f(x - kStep)) / (2 * kStep);
}
constexpr double kDifferenceError = 1e-7;

}  // namespace

TEST_CASE("a bounded slope is tau / (1 + tau) with tau = x + sqrt(1 + x^2)") {
  for (const double x : kSlopes) {
    const auto b = bounded_from_slope(x);
    CAPTURE(x);
    CHECK(b.sigma == Approx(1 / (1 + std::exp(-std::asinh(x)))).epsilon(kExpRounding));
    CHECK(b.sigma + b.complement == Approx(1).epsilon(kRounding));
  }
}

TEST_CASE("a bounded slope decodes to the slope and to sqrt(1 + x^2)") {
  for (const double x : kSlopes) {
    const auto b = bounded_from_slope(x);
    CAPTURE(x);
    CHECK(std::abs(b.slope() - x) <= 1e-15 * (1 + std::abs(x)));
    CHECK(b.hypotenuse() / b.denominator() == Approx(std::hypot(1, x)).epsilon(1e-15));
  }
}

TEST_CASE("infinite slopes are 0 and 1") {
  const double infinity = std::numeric_limits<double>::infinity();
  CHECK(bounded_from_slope(-infinity).sigma == 0);
  CHECK(bounded_from_slope(infinity).sigma == 1);
  CHECK(bounded_from_sigma(0.0).slope() == -infinity);
}

TEST_CASE("a bounded slope keeps relative precision in the lower tail") {
  const float x = -3e7f;
  CHECK(bounded_from_slope(x).slope() == Approx(x).epsilon(1e-6));
}

TEST_CASE("the bounded cotangent of a direction is that of its slope") {
  for (const double theta : {1e-9, 0.01, 0.5, 1.0, 1.5, 1.570796}) {
    const auto direct = bounded_cotangent(std::cos(theta), std::sin(theta));
    const auto by_slope = bounded_from_slope(std::cos(theta) / std::sin(theta));
    CHECK(direct.sigma == Approx(by_slope.sigma).epsilon(kRounding));
    CHECK(direct.complement == Approx(by_slope.complement).epsilon(kRounding));
  }
  CHECK(bounded_cotangent(1.0, 0.0).complement == 0);
  CHECK(bounded_cotangent(0.0, 1.0).sigma == 0.5);
}

TEST_CASE("base coordinates and their inverses undo each other") {
  for (const double row : kUnit) {
    CAPTURE(row);
    CHECK(marginal_base(marginal_base_inverse(row)) == Approx(row).margin(1e-15));
    const double margin = row < 0.01 ? kRowRounding : 1e-15;
    const auto x = bounded_from_slope(conditional_base_inverse(row));
    CHECK(conditional_base(x) == Approx(row).margin(margin));
  }
}

TEST_CASE("the base coordinate of a direction below the horizon mirrors that of the one above") {
  for (const double x : {1e-12, 1e-3, 0.4, 3.0, 1e5}) {
    const auto below = bounded_cotangent(-x, 1.0), above = bounded_cotangent(x, 1.0);
    CHECK(marginal_base(below) == Approx(2 - marginal_base(above)).epsilon(1e-15));
    const auto back = marginal_base_inverse(marginal_base(below));
    CHECK(back.slope() == Approx(-x).epsilon(1e-9).margin(1e-15));
    CHECK(marginal_scale(below) == Approx(2 * below.sigma));
    CHECK(marginal_scale(above) == 1);
  }
}

TEST_CASE("base coordinates run from normal incidence to grazing, and from slope 0 to infinity") {
  CHECK(marginal_base(bounded_cotangent(1.0, 0.0)) == 0);
  CHECK(marginal_base(bounded_cotangent(0.0, 1.0)) == 1);
  CHECK(marginal_base(bounded_cotangent(-1.0, 0.0)) == 2);
  CHECK(conditional_base(bounded_from_slope(0.0)) == 0);
  CHECK(conditional_base(bounded_from_slope(std::numeric_limits<double>::infinity())) == 1);
}

TEST_CASE("a conditional base coordinate serves both signs of the slope") {
  CHECK(conditional_base(bounded_from_slope(2.5)) == conditional_base(bounded_from_slope(-2.5)));
}

TEST_CASE("column coordinates and their inverses undo each other") {
  for (const double t : kUnit) {
    CAPTURE(t);
    CHECK(marginal_column(marginal_column_inverse(t)) == Approx(t).margin(1e-15));
    CHECK(conditional_column(conditional_column_inverse(t)) == Approx(t).margin(1e-15));
  }
}

TEST_CASE("columns are symmetric for the marginal and folded for the conditional") {
  for (const double u : {1e-12, 1e-4, 0.2, 0.5}) {
    CHECK(marginal_column(Probability<double>{u, 1 - u}) ==
          Approx(1 - marginal_column(Probability<double>{1 - u, u})).epsilon(1e-12));
    CHECK(fold(Probability<double>{u, 1 - u}).p.u == fold(Probability<double>{1 - u, u}).p.u);
  }
  CHECK(fold(probability(0.25)).sign == -1);
  CHECK(fold(probability(0.75)).sign == 1);
}

TEST_CASE("a probability outside [0, 1] goes to the nearer end, not a number to 0") {
  CHECK(probability(-1.0).u == 0);
  CHECK(probability(2.0).u == 1);
  CHECK(probability(2.0).complement == 0);
  CHECK(probability(std::numeric_limits<double>::quiet_NaN()).u == 0);
}

TEST_CASE("u2 is folded to the probability of a smaller |y|") {
  CHECK(fold(probability(0.25)).p.u == 0.5);
  CHECK(fold(probability(0.25)).p.complement == 0.5);
  CHECK(fold(probability(0.0)).p.u == 1);
  CHECK(fold(probability(0.5)).p.u == 0);
}

TEST_CASE("the scale of the conditional is sqrt(max(0, A + B x^2)), exact at the rim for B < 0") {
  const auto at = [](double constant, double quadratic, double x) {
    return ConditionalScale<double>{constant, quadratic}.at({x, 1.0});
  };
  CHECK(at(1, 0, 7) == 1);
  CHECK(at(2, 3, -5) == Approx(std::sqrt(77)).epsilon(kRounding));
  // (R - x)(R + x) with R - x = 2^-40 R keeps all its digits; R^2 - x^2 would keep twelve bits.
  const double r = 1.7, x = r * (1 - 0x1p-40);
  CHECK(at(r * r, -1, x) == Approx(std::sqrt((r - x) * (r + x))).epsilon(kRounding));
  CHECK(at(r * r, -1, r) == 0);
  CHECK(at(r * r, -1, 2 * r) == 0);
}

TEST_CASE("a conditional value v stands for the slope 2 v / (1 - v^2)") {
  for (const double y : {0.0, 1e-6, 0.5, 3.0, 1e5}) {
    const double v = conditional_value(bounded_from_slope(y));
    CHECK(conditional_value_inverse(v).slope() == Approx(y).epsilon(1e-9));
  }
}

TEST_CASE("the rates of the columns are the derivatives of their inverses, and 0 at the ends") {
  for (double t = 0.01; t < 1; t += 0.01) {
    CHECK(marginal_column_rate(t) ==
          Approx(difference([](double s) { return marginal_column_inverse(s).u; }, t))
              .margin(kDifferenceError));
    CHECK(conditional_column_rate(t) ==
          Approx(difference([](double s) { return conditional_column_inverse(s).u; }, t))
              .margin(kDifferenceError));
  }
  for (const double end : {0.0, 1.0}) {
    CHECK(marginal_column_rate(end) == 0);
    CHECK(conditional_column_rate(end) == 0);
  }
  CHECK(conditional_column_rate(1e-9) == Approx(4e-9).epsilon(1e-6));
}

TEST_CASE("unfold undoes fold") {
  for (const double u : {0.0, 1e-9, 0.3, 0.5, 0.7, 1 - 1e-9, 1.0})
    CHECK(unfold(fold(probability(u))) == Approx(u).epsilon(1e-15));
}

TEST_CASE("a fraction is bounded as its quotient is, infinite at denominator 0") {
  for (const double x : {-3.0, -1e-9, 0.0, 0.7, 1e12}) {
    const auto whole = bounded_from_slope(x), part = bounded_from_fraction(x * 1e-20, 1e-20);
    CHECK(part.sigma == Approx(whole.sigma).epsilon(1e-14));
    CHECK(part.complement == Approx(whole.complement).epsilon(1e-14));
  }
  CHECK(bounded_from_fraction(-1.0, 0.0).sigma == 0);
  CHECK(bounded_from_fraction(1.0, 0.0).complement == 0);
}
