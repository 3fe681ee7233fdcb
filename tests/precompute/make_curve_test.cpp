// Sampling functions into curves.
#include "vndf/precompute/make_curve.h"

#include <cmath>
#include <limits>

#include "support/catch.h"

using namespace vndf;
using namespace vndf::precompute;
using vndf::test::Approx;

TEST_CASE("a sampled curve equals its function between the nodes") {
  const auto log_f = [](double a) { return -3 * std::log(std::cosh(a)); };
  const auto curve = make_curve(log_f, {0, 20}, {.nodes = 2048}, {});
  for (double a = 0; a < 20; a += 0.0173) REQUIRE(curve.log_at(a) == Approx(log_f(a)).margin(1e-9));
}

TEST_CASE("a cusp at slope 0 is met by a graded curve") {
  const auto log_f = [](double a) { return -std::sqrt(a); };
  const auto curve = make_curve(log_f, {0, 20}, {.nodes = 2048, .cusp = true}, {});
  for (double a = 1e-6; a < 20; a *= 1.1) REQUIRE(curve.log_at(a) == Approx(log_f(a)).margin(1e-9));
}

TEST_CASE("a jump between segments is kept, and a segment of zeros left out") {
  const auto log_f = [](double a) {
    return a < 1 ? -std::numeric_limits<double>::infinity() : a < 2 ? 1.0 : 3.0;
  };
  const auto curve = make_curve(log_f, {0, 1, 2, 3}, {.nodes = 16, .open = false}, {});
  CHECK(curve.segments().size() == 2);
  CHECK(curve.at(0.5) == 0);
  CHECK(curve.log_at(1.5) == Approx(1));
  CHECK(curve.log_at(2.5) == Approx(3));
  CHECK(curve.at(3.5) == 0);
}
