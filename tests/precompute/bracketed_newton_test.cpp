// Root finding in a bracket.
#include "vndf/precompute/bracketed_newton.h"

#include <cmath>

#include "support/catch.h"

using vndf::precompute::bracketed_newton;
using vndf::precompute::ValueAndSlope;
using vndf::test::Approx;

TEST_CASE("Newton steps find the root of a smooth function in few evaluations") {
  int evaluations = 0;
  const auto f = [&](double x) {
    ++evaluations;
    return ValueAndSlope{2 - std::exp(x), -std::exp(x)};
  };
  CHECK(bracketed_newton(f, {-10, 10}, 1) == Approx(std::log(2.0)).epsilon(1e-14));
  CHECK(evaluations < 10);
}

TEST_CASE("bisection takes over where a step would leave the bracket or is not a number") {
  const auto steep = [](double x) { return ValueAndSlope{-std::cbrt(x - 0.7), -1e-9}; };
  CHECK(bracketed_newton(steep, {0, 1}, 0.01) == Approx(0.7).epsilon(1e-14));
  const auto flat = [](double x) { return ValueAndSlope{x < 0.3 ? 1.0 : -1.0, 0.0}; };
  CHECK(bracketed_newton(flat, {0, 1}, 0.5) == Approx(0.3).epsilon(1e-14));
  const auto lost = [](double x) { return ValueAndSlope{x < 5 ? 1.0 : -INFINITY, NAN}; };
  CHECK(bracketed_newton(lost, {0, 700}, 1) == Approx(5).epsilon(1e-14));
}

TEST_CASE("a residual of exactly zero ends the search there, not at the middle of the bracket") {
  const auto f = [](double x) { return ValueAndSlope{0.25 - x, -1}; };
  CHECK(bracketed_newton(f, {0, 1}, 0.25) == 0.25);
}

TEST_CASE("a guess outside the bracket is replaced") {
  const auto f = [](double x) { return ValueAndSlope{0.25 - x, -1}; };
  CHECK(bracketed_newton(f, {0, 1}, -50) == Approx(0.25));
  CHECK(bracketed_newton(f, {0, 1}, NAN) == Approx(0.25));
}

TEST_CASE("a root at an end of the bracket is met to rounding") {
  const auto f = [](double x) { return ValueAndSlope{0.5 - x, -1}; };
  CHECK(bracketed_newton(f, {0, 0.5}, 0.5 - 4e-9) == 0.5);
  CHECK(bracketed_newton(f, {0.5, 1}, 0.5 + 4e-9) == 0.5);
}
