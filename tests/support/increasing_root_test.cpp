// Roots with known values, among them those that defeat Newton's method alone.
#include "vndf/support/increasing_root.h"

#include "support/catch.h"

using namespace vndf;
using namespace vndf::test;

TEST_CASE("increasing_root finds a root to rounding from any guess, inside the bracket or not") {
  const auto f = [](double x) { return support::ValueAndDerivative{x * x * x - 2, 3 * x * x}; };
  for (const double guess : {-10.0, 0.0, 1e-3, 1.2, 1.9, 50.0})
    CHECK(support::increasing_root(f, 0, 2, guess) == Approx(std::cbrt(2.0)).epsilon(1e-15));
}

TEST_CASE("increasing_root bisects where Newton's method runs away") {
  const auto f = [](double x) {
    return support::ValueAndDerivative{std::atan(x), 1 / (1 + x * x)};
  };
  CHECK(std::abs(support::increasing_root(f, -1e6, 1e7, 9e6)) < 1e-15);
}

TEST_CASE("increasing_root returns an end of the bracket that is the root") {
  const auto f = [](double x) { return support::ValueAndDerivative{x - 3, 1}; };
  CHECK(support::increasing_root(f, 3, 5, 4) == Approx(3).epsilon(1e-15));
  CHECK(support::increasing_root(f, 1, 3, 2) == Approx(3).epsilon(1e-15));
}
