// The map of a marginal table against the closed form of its base distribution for GGX.
#include "vndf/precompute/marginal_map.h"

#include <cmath>
#include <numbers>

#include "support/catch.h"
#include "vndf/distributions/families.h"
#include "vndf/distributions/parse_distribution.h"
#include "vndf/table_coordinates.h"

using namespace vndf;
using namespace vndf::distributions;
using namespace vndf::precompute;
using vndf::test::Approx;

namespace {

/// int_-inf^x P / sigma for GGX, 1 / sigma = 1 + sqrt(1 + t^2) - t and h = sqrt(1 + x^2): the first
/// part is F, the second half of atan, the third M = 1 / (2 h). The total is 1 + pi / 2.
double base_cdf(double x) {
  const double h = std::hypot(1, x);
  const double f = x < 0 ? 1 / (2 * h * (h - x)) : 1 - 1 / (2 * h * (h + x));
  const double angle = x < 0 ? std::atan(-1 / x) : std::numbers::pi - std::atan2(1, x);
  return (f + angle / 2 + 1 / (2 * h)) / (1 + std::numbers::pi / 2);
}

}  // namespace

TEST_CASE("the map of GGX is the quantile function of its base density") {
  constexpr std::size_t kPieces = 256;
  const auto ggx = parse_distribution("ggx");
  const UnitSlopes slopes(*ggx, {});
  const auto nodes = marginal_map(slopes, kPieces);
  REQUIRE(nodes.size() == kPieces + 1);
  CHECK(nodes.front().value == 0);
  CHECK(nodes.back().value == 1);
  for (std::size_t k = 1; k < kPieces; ++k) {
    const auto u = marginal_column_inverse(static_cast<double>(k) / kPieces);
    const double mass = base_cdf(bounded_from_sigma(nodes[k].value).slope());
    // P is good to 1e-8, and what lies beyond a moment of 1e-16 is cut off.
    CHECK(mass == Approx(u.u).epsilon(1e-7).margin(1e-16));
  }
}

TEST_CASE("the tangents of the map are its derivative per node") {
  const auto mixture = parse_distribution("mixture:0.5*ggx+0.5*beckmann@0.1");
  const UnitSlopes slopes(*mixture, {});
  const auto nodes = marginal_map(slopes);
  REQUIRE(nodes.size() == kMapPieces + 1);
  // The central difference errs with the third derivative, which is large at the corners.
  for (std::size_t k = 32; k + 32 < nodes.size(); k += 7)
    CHECK(nodes[k].tangent == Approx((nodes[k + 1].value - nodes[k - 1].value) / 2).epsilon(2e-3));
}

TEST_CASE("the map of a compact distribution ends at its largest slope") {
  const auto disk = parse_distribution("disk");
  const UnitSlopes slopes(*disk, {});
  const auto nodes = marginal_map(slopes, 64);
  CHECK(nodes.back().value == Approx(bounded_from_slope(slopes.support()).sigma).epsilon(1e-14));
  for (std::size_t k = 1; k < nodes.size(); ++k) CHECK(nodes[k].value > nodes[k - 1].value);
}

TEST_CASE("the map of a ring too thin for its panels does not turn back") {
  const Annulus ring(1 - 1e-11);
  const UnitSlopes slopes(ring, {});
  const auto nodes = marginal_map(slopes);
  for (std::size_t k = 1; k < nodes.size(); ++k) REQUIRE(nodes[k].value >= nodes[k - 1].value);
}
