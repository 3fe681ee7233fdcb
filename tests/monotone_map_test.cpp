// The map and its inverse.
#include "vndf/monotone_map.h"

#include <cmath>
#include <limits>

#include "catch.h"

using namespace vndf;
using vndf::test::Approx;

namespace {

/// x^4 at 17 nodes, with its derivative per node spacing.
std::vector<MonotoneNode> fourth_power() {
  std::vector<MonotoneNode> nodes;
  for (int k = 0; k <= 16; ++k) {
    const double x = k / 16.0;
    nodes.push_back({x * x * x * x, 4 * x * x * x / 16});
  }
  return nodes;
}

/// Nodes with a flat piece, a steep piece, and tangents far from the secants.
std::vector<MonotoneNode> uneven() {
  return {{0, 0}, {0, 0}, {1e-6, 2}, {0.5, 0}, {0.5, 0}, {1, 50}};
}

}  // namespace

TEST_CASE("a map without nodes is the identity") {
  const MonotoneMap<double> map;
  CHECK(map.identity());
  CHECK(map.at(0.3) == 0.3);
  CHECK(map.inverse(0.3) == 0.3);
}

TEST_CASE("a map goes through its nodes and, between them, errs with the fourth order") {
  const MonotoneMap<double> map(fourth_power());
  for (int k = 0; k <= 16; ++k) CHECK(map.at(k / 16.0) == Approx(std::pow(k / 16.0, 4)));
  for (double x = 0.01; x < 1; x += 0.013)
    CHECK(map.at(x) == Approx(std::pow(x, 4)).margin(std::pow(1 / 16.0, 4)));
}

TEST_CASE("a map increases for any nodes that do") {
  const MonotoneMap<double> map(uneven());
  double last = 0;
  for (int i = 0; i <= 10000; ++i) {
    const double value = map.at(i / 10000.0);
    REQUIRE(value >= last);
    last = value;
  }
  CHECK(last == 1);
}

TEST_CASE("the inverse undoes the map, to rounding") {
  const MonotoneMap<double> smooth(fourth_power());
  for (int i = 0; i <= 1000; ++i)
    CHECK(smooth.inverse(smooth.at(i / 1e3)) == Approx(i / 1e3).margin(1e-12));
  const MonotoneMap<double> steep(uneven());
  for (int i = 0; i <= 1000; ++i)
    CHECK(steep.at(steep.inverse(i / 1e3)) == Approx(i / 1e3).margin(1e-12));
}

TEST_CASE("arguments outside [0, 1] go to the nearer end") {
  const MonotoneMap<float> map(fourth_power());
  CHECK(map.at(-1.0f) == 0);
  CHECK(map.at(2.0f) == 1);
  CHECK(map.at(std::numeric_limits<float>::quiet_NaN()) == 0);
  CHECK(map.inverse(-1.0f) == 0);
  CHECK(map.inverse(2.0f) == 1);
}
