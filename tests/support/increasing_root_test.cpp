// Roots with known values, among them those that defeat Newton's method alone.
#include "vndf/support/increasing_root.h"

#include <cmath>

#include "support/catch.h"
#include "vndf/cubic_piece.h"

using vndf::support::increasing_root;
using vndf::test::Approx;

using At = vndf::WithDerivative<double>;

TEST_CASE("increasing_root finds a root to rounding from any guess, inside the bracket or not") {
  const auto f = [](double x) { return At{x * x * x - 2, 3 * x * x}; };
  for (const double guess : {-10.0, 0.0, 1e-3, 1.2, 1.9, 50.0, double{NAN}})
    CHECK(increasing_root(f, 0, 2, guess) == Approx(std::cbrt(2.0)).epsilon(1e-15));
}

TEST_CASE("increasing_root needs few evaluations of a smooth function") {
  int evaluations = 0;
  const auto f = [&](double x) {
    ++evaluations;
    return At{std::exp(x) - 2, std::exp(x)};
  };
  CHECK(increasing_root(f, -10, 10, 1) == Approx(std::log(2.0)).epsilon(1e-14));
  CHECK(evaluations < 10);
}

TEST_CASE("increasing_root bisects where Newton's method runs away") {
  const auto f = [](double x) { return At{std::atan(x), 1 / (1 + x * x)}; };
  CHECK(std::abs(increasing_root(f, -1e6, 1e7, 9e6)) < 1e-15);
}

TEST_CASE("increasing_root bisects where a step would leave the bracket or is not a number") {
  const auto steep = [](double x) { return At{std::cbrt(x - 0.7), 1e-9}; };
  CHECK(increasing_root(steep, 0, 1, 0.01) == Approx(0.7).epsilon(1e-14));
  const auto flat = [](double x) { return At{x < 0.3 ? -1.0 : 1.0, 0.0}; };
  CHECK(increasing_root(flat, 0, 1, 0.5) == Approx(0.3).epsilon(1e-14));
  const auto lost = [](double x) { return At{x < 5 ? -1.0 : INFINITY, NAN}; };
  CHECK(increasing_root(lost, 0, 700, 1) == Approx(5).epsilon(1e-14));
}

TEST_CASE("a residual of exactly zero ends the search there, not at the middle of the bracket") {
  const auto f = [](double x) { return At{x - 0.25, 1}; };
  CHECK(increasing_root(f, 0, 1, 0.25) == 0.25);
}

TEST_CASE("increasing_root returns an end of the bracket that is the root") {
  const auto f = [](double x) { return At{x - 3, 1}; };
  CHECK(increasing_root(f, 3, 5, 4) == 3);
  CHECK(increasing_root(f, 1, 3, 2) == 3);
  CHECK(increasing_root(f, 3, 5, 3 + 4e-9) == 3);
  CHECK(increasing_root(f, 1, 3, 3 - 4e-9) == 3);
}
