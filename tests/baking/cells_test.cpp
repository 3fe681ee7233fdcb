// Cubics between two nodes of a cell: through both, and turning back nowhere where they are
// limited.
#include "vndf/baking/cells.h"

#include <algorithm>

#include "support/catch.h"

using namespace vndf;
using namespace vndf::baking;

namespace {

/// The largest step back of the cubic over its cell of width `width`.
double step_back(const Cubic& cubic, double width) {
  double largest = 0;
  for (int k = 0; k < 1000; ++k)
    largest = std::max(largest, at(cubic, k * width / 1000) - at(cubic, (k + 1) * width / 1000));
  return largest;
}

}  // namespace

TEST_CASE("a cubic goes through both nodes with their derivatives") {
  const Cubic c = hermite({1, 0.5}, {2, 0.25}, 4);
  CHECK(at(c, 0) == Approx(1));
  CHECK(at(c, 4) == Approx(2));
  CHECK(c[1] == Approx(0.5));
  CHECK(c[1] + 4 * (2 * c[2] + 4 * 3 * c[3]) == Approx(0.25));
}

TEST_CASE("limited derivatives keep a cubic from turning back, where it would without") {
  // The rise is 1 over a width of 2, so that derivatives above 3 / 2 or below 0 are too steep.
  for (const auto& [left, right] : {std::pair{9.0, 9.0}, {9.0, 0.0}, {0.0, 9.0}, {-1.0, 0.5}}) {
    CAPTURE(left, right);
    CHECK_FALSE(is_monotone({0, left}, {1, right}, 2));
    CHECK(step_back(hermite({0, left}, {1, right}, 2), 2) > 1e-3);
    const Cubic limited = monotone_hermite({0, left}, {1, right}, 2);
    CHECK(step_back(limited, 2) <= 1e-15);
    CHECK(at(limited, 0) == 0);
    CHECK(at(limited, 2) == Approx(1));
  }
}

TEST_CASE("derivatives that are not too steep stay as they are") {
  const Node low{0, 1.4}, high{1, 0.1};
  CHECK(is_monotone(low, high, 2));
  CHECK(monotone_hermite(low, high, 2) == hermite(low, high, 2));
}
