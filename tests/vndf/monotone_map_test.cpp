// The map and its inverse.
#include "vndf/monotone_map.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "support/catch.h"

using namespace vndf;
using vndf::test::Approx;

namespace {

constexpr double kQuarter = std::numbers::pi / 2;

/// sin(pi x / 2) at 17 nodes, with its derivative per node spacing.
std::vector<CubicNode<double>> sine() {
  std::vector<CubicNode<double>> nodes;
  for (int k = 0; k <= 16; ++k) {
    const double x = kQuarter * k / 16;
    nodes.push_back({std::sin(x), kQuarter / 16 * std::abs(std::cos(x))});
  }
  return nodes;
}

/// Nodes with a flat piece, a steep piece, and the steepest tangents there may be.
std::vector<CubicNode<double>> uneven() {
  return {{0, 0}, {0, 0}, {1e-6, 3e-6}, {0.5, 0}, {0.5, 0}, {1, 1.5}};
}

}  // namespace

TEST_CASE("a map goes through its nodes and, between them, errs with the fourth order") {
  const MonotoneMap map(sine());
  for (int k = 0; k <= 16; ++k) CHECK(map.at(k / 16.0) == Approx(std::sin(kQuarter * k / 16)));
  const double error = std::pow(kQuarter / 16, 4) / 384;
  for (double x = 0.01; x < 1; x += 0.013)
    CHECK(std::abs(map.at(x) - std::sin(kQuarter * x)) <= error);
}

TEST_CASE("a map increases for any nodes that do") {
  const MonotoneMap map(uneven());
  double last = 0;
  for (int i = 0; i <= 10000; ++i) {
    const double value = map.at(i / 10000.0);
    REQUIRE(value >= last);
    last = value;
  }
  CHECK(last == 1);
}

TEST_CASE("the inverse undoes the map, to rounding") {
  const MonotoneMap smooth(sine());
  for (int i = 0; i <= 1000; ++i)
    CHECK(smooth.inverse(smooth.at(i / 1e3)) == Approx(i / 1e3).margin(1e-12));
  const MonotoneMap steep(uneven());
  for (int i = 0; i <= 1000; ++i)
    CHECK(steep.at(steep.inverse(i / 1e3)) == Approx(i / 1e3).margin(1e-12));
}

TEST_CASE("arguments outside [0, 1] go to the nearer end") {
  const MonotoneMap map(sine());
  CHECK(map.at(-1) == 0);
  CHECK(map.at(2) == 1);
  CHECK(map.at(std::numeric_limits<double>::quiet_NaN()) == 0);
  CHECK(map.inverse(-1) == 0);
  CHECK(map.inverse(2) == 1);
}

TEST_CASE("the derivative of a map is that of its values") {
  const MonotoneMap map({{0, 0}, {0.1, 0.15}, {0.5, 0.2}, {1, 0.6}});
  constexpr double kStep = 1e-6;
  for (double s = 0.01; s < 1; s += 0.0371) {
    const auto at = map.at_with_derivative(s);
    CHECK(at.value == map.at(s));
    CHECK(at.derivative ==
          Approx((map.at(s + kStep) - map.at(s - kStep)) / (2 * kStep)).epsilon(1e-4));
  }
}
