// Slope maps drawn from known distributions, and maps that are no slope distribution.
#include "vndf/distributions/slope_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/catch.h"
#include "support/visible_difference.h"

using namespace vndf;
using namespace vndf::distributions;
using namespace vndf::precompute;
using namespace vndf::test;

namespace {

constexpr std::size_t kTexels = 1024 * 1024;
/// Centre (in units of alpha), alpha (relative) and correlation of a million texels: one standard
/// deviation is about 1e-3 of each for these distributions; measured: 3e-3 at most.
constexpr double kStretchError = 5e-3;

using Slopes = std::vector<Vec2<double>>;

constexpr double kGamma = 2.5;

class StudentT final : public SlopeDistribution {
 public:
  std::string name() const override { return "student-t"; }
  double p22(double r) const override {
    return std::pow(1 + r * r / (kGamma - 1), -kGamma) * std::numbers::inv_pi;
  }
};

class Gaussian final : public SlopeDistribution {
 public:
  std::string name() const override { return "gaussian"; }
  double p22(double r) const override { return std::exp(-r * r) * std::numbers::inv_pi; }
};

double student_radius(double tail) {
  return std::sqrt((kGamma - 1) * (std::pow(tail, 1 / (1 - kGamma)) - 1));
}
double gaussian_radius(double tail) {
  return std::sqrt(-std::log(tail));
}

/// Slopes whose radii have the given inverse upper tail.
template <class Radius>
Slopes radial_slopes(Radius radius, std::size_t count = kTexels) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> uniform(0, 1);
  Slopes slopes;
  for (std::size_t i = 0; i < count; ++i) {
    const double r = radius(1 - uniform(random)), phi = 2 * std::numbers::pi * uniform(random);
    slopes.push_back({r * std::cos(phi), r * std::sin(phi)});
  }
  return slopes;
}

constexpr double kMeanX = 0.1, kMeanY = -0.05, kScaleX = 0.3, kScaleY = 0.1, kCorrelation = 0.4;

Slopes stretched(Slopes slopes) {
  const double rest = std::sqrt(1 - kCorrelation * kCorrelation);
  for (auto& s : slopes)
    s = {kMeanX + kScaleX * s.x, kMeanY + kScaleY * (kCorrelation * s.x + rest * s.y)};
  return slopes;
}

/// The stretch and every visible CDF come back; the latter within the reported error itself.
void check_recovered(const SlopeDistribution& drawn, const Slopes& unit_slopes, ProfileTail tail) {
  const SlopeMapEstimate estimate = estimate_slope_map(stretched(unit_slopes));
  const SlopeMapStatistics& s = estimate.statistics;
  const UnitSlopes exact(drawn, {}), measured(*estimate.distribution, {});
  const double alpha_x = kScaleX * exact.mean_slope(), alpha_y = kScaleY * exact.mean_slope();
  CHECK(s.texels == kTexels);
  CHECK(std::abs(s.surface.mean.x - kMeanX) < kStretchError * alpha_x);
  CHECK(std::abs(s.surface.mean.y - kMeanY) < kStretchError * alpha_y);
  CHECK(s.surface.alpha.x == Approx(alpha_x).epsilon(kStretchError));
  CHECK(s.surface.alpha.y == Approx(alpha_y).epsilon(kStretchError));
  CHECK(s.surface.correlation == Approx(kCorrelation).margin(kStretchError));
  CHECK(s.asymmetry < 0.01);
  CHECK(s.u_error < 2.5e-3);
  CHECK(estimate.distribution->tail().kind == tail);
  CHECK(estimate.distribution->mass() == Approx(1));
  CHECK(estimate.distribution->mean_slope() == Approx(1));
  CHECK(largest_difference(exact, measured) < s.u_error);
}

Slopes square_slopes() {
  std::mt19937_64 random(13);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Slopes slopes;
  for (int i = 0; i < 100000; ++i) slopes.push_back({uniform(random), uniform(random)});
  return slopes;
}

/// Two facets, each with a little roughness.
Slopes two_lobes() {
  Slopes slopes = radial_slopes(gaussian_radius, 100000);
  for (std::size_t i = 0; i < slopes.size(); ++i) slopes[i].x += i % 2 == 0 ? 2 : -2;
  return slopes;
}

}  // namespace

TEST_CASE("a map of Student-T slopes gives its stretch and its visible CDFs back") {
  check_recovered(StudentT(), radial_slopes(student_radius), ProfileTail::power);
}

TEST_CASE("a map of Gaussian slopes gives its stretch and its visible CDFs back") {
  check_recovered(Gaussian(), radial_slopes(gaussian_radius), ProfileTail::exponential);
}

TEST_CASE("a map of slopes in a disk ends where they end") {
  const auto estimate = estimate_slope_map(radial_slopes([](double v) { return std::sqrt(v); }));
  const double mean_slope = 4 / (3 * std::numbers::pi);
  CHECK(estimate.statistics.surface.alpha.x == Approx(mean_slope).epsilon(kStretchError));
  // The edge is as sharp as the estimated stretch is exact.
  CHECK(estimate.distribution->marginals(1.05 / mean_slope)->q < 1e-6);
}

TEST_CASE("few texels give a large error that still holds") {
  const auto estimate = estimate_slope_map(radial_slopes(student_radius, kFewestTexels));
  const StudentT drawn;
  const UnitSlopes exact(drawn, {}), measured(*estimate.distribution, {});
  CHECK(estimate.statistics.u_error > 0.04);
  CHECK(largest_difference(exact, measured) < estimate.statistics.u_error);
}

TEST_CASE("slopes that are not radially symmetric are refused, unless that is ignored") {
  for (const Slopes& slopes : {square_slopes(), two_lobes()}) {
    CHECK_THROWS_WITH(estimate_slope_map(slopes), contains("asymmetry") && contains("exceeds") &&
                                                      contains("option to ignore asymmetry"));
    CHECK_THROWS_AS(estimate_slope_map(slopes), AsymmetricMap);
    const auto averaged = estimate_slope_map(slopes, {.name = "lobes", .ignore_asymmetry = true});
    CHECK(averaged.statistics.asymmetry > averaged.statistics.asymmetry_bound);
    CHECK(averaged.distribution->name() == "lobes");
    CHECK(averaged.distribution->mean_slope() == Approx(1));
  }
}

TEST_CASE("a map with eight bits in each component is accepted") {
  Slopes slopes = radial_slopes(gaussian_radius, 100000);
  for (auto& s : slopes) s = {std::round(40 * s.x) / 127, std::round(40 * s.y) / 127};
  const auto estimate = estimate_slope_map(slopes);
  const double alpha = 40 * std::numbers::inv_sqrtpi / 127;
  CHECK(estimate.statistics.surface.alpha.x == Approx(alpha).epsilon(0.02));
  CHECK(estimate.distribution->p22(0) > 0);
}

TEST_CASE("maps without a slope distribution are refused") {
  const auto refused = [](const Slopes& slopes, const std::string& why) {
    CHECK_THROWS_WITH(estimate_slope_map(slopes), contains(why));
    CHECK_THROWS_AS(estimate_slope_map(slopes), std::domain_error);
  };
  refused(Slopes(2000, {0.3, 0.1}), "same slope");
  refused(radial_slopes(gaussian_radius, 999), "at least 1000");
  Slopes slopes = radial_slopes(gaussian_radius, 2000);
  slopes[17].y = std::numeric_limits<double>::quiet_NaN();
  refused(slopes, "texel 17 is not finite");
  for (auto& s : slopes) s.y = 2 * s.x;
  refused(slopes, "two directions");
  slopes = radial_slopes(gaussian_radius, 2000);
  for (std::size_t i = 0; i < 1500; ++i) slopes[i] = {0, 0};
  refused(slopes, "too many of them are equal");
  // r^-2.8: no mean slope.
  refused(radial_slopes([](double v) { return std::pow(v, -1 / 0.8); }, 100000), "above 3");
}
