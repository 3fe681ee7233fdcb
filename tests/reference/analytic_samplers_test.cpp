// The analytic methods of supplemental 1: their distributions against the closed CDFs, and their
// defects, which must stay what the docstrings say.
#include <array>
#include <utility>

#include "support/catch.h"
#include "support/tolerances.h"
#include "support/visible_normals.h"
#include "vndf/reference/beckmann_analytic.h"
#include "vndf/reference/ggx_analytic.h"

using namespace vndf;
using namespace vndf::test;

namespace {

// The cone of normal incidence ends at 0.2562 degrees, in float within a rounding of the cosine.
constexpr double kInsideCone = 0.2562;
const std::vector<double> kOutsideCone{0.26, 0.5, 1,  5,    20,    30,         45, 60,
                                       75,   85,  89, 89.9, 89.99, 89.9999999, 90};

// The Gaussian slope_y in double: rounding.
constexpr double kConditionalError = 1e-15;

// Kolmogorov distance of the 2^18 even pairs of an exact sampler, in x and in y.
constexpr double kPairError = 2.5e-4;

/// Kolmogorov distance of the distribution of slope_x under Algorithm 2 from the exact one. u2
/// swaps the sign of slope_x with a probability that is known, so that each u1 gives a weight to
/// two slopes: far less noise than by pairs. `y` is the largest |CDF - rest of u2| of slope_y.
template <class T>
DistributionErrors swap_distribution_errors(double degrees) {
  constexpr int kCount = 1 << 17;
  // Small enough to swap or not at any but extreme probabilities, and a slope_y that float holds.
  constexpr double kSmall = 1e-6;
  const BeckmannAnalytic<T> sampler;
  const auto wi = direction_at<T>(degrees);
  const Alpha<T> one{1, 1};
  const VisibleDistribution<BeckmannForms> distribution(wi, one);
  const double c = double{wi.z} / double{wi.x};
  std::vector<std::pair<double, double>> weighted;
  DistributionErrors worst;
  for (int k = 0; k < kCount; ++k) {
    const T u1 = static_cast<T>((k + 0.5) / kCount);
    const auto at = [&](double u2) { return sampler.sample(wi, one, u1, static_cast<T>(u2)); };
    const auto kept = at(kSmall), swapped = at(1 - kSmall);
    const double x = distribution.slope(kept).x, other = distribution.slope(swapped).x;
    if (std::abs(x) < c && std::abs(x + other) < 1e-3 * std::abs(x)) {
      const double p = 0.5 - x / (2 * c);
      weighted.push_back({distribution(kept).x, p});
      weighted.push_back({distribution(swapped).x, 1 - p});
    } else {
      weighted.push_back({distribution(at(0.5)).x, 1});
      // Where the interval below -cot(theta) was chosen, all of u2 is left for slope_y.
      if (std::abs(x) >= c)
        for (const double u2 : {0.01, 0.3, 0.5, 0.9})
          worst.y =
              std::max(worst.y, std::abs(distribution(at(u2)).y - double{static_cast<T>(u2)}));
    }
  }
  std::sort(weighted.begin(), weighted.end());
  double below = 0;
  for (const auto& [number, weight] : weighted) {
    const double next = below + weight / kCount;
    take_larger(worst, std::max(std::abs(number - below), std::abs(number - next)), 0);
    below = next;
  }
  return worst;
}

/// CDF of a slope_y after a swap or none, as u2 runs through [0, 1]: uniform within each part.
double rest_error(double degrees, double u1) {
  const BeckmannAnalytic<double> sampler;
  const auto wi = direction_at<double>(degrees);
  const VisibleDistribution<BeckmannForms> distribution(wi, Alpha<double>{1, 1});
  const double x = distribution.slope(sampler.sample(wi, {1, 1}, u1, 1e-9)).x;
  const double p = 0.5 - x * wi.x / (2 * wi.z);
  double worst = 0;
  for (int k = 1; k < 500; ++k) {
    const double u2 = k / 500.0, rest = u2 <= p ? u2 / p : (u2 - p) / (1 - p);
    worst = std::max(worst, std::abs(distribution(sampler.sample(wi, {1, 1}, u1, u2)).y - rest));
  }
  return worst;
}

}  // namespace

TEST_CASE("analytic Beckmann: the distribution of slope_x is exact to rounding outside the cone") {
  DistributionErrors in_double, in_float;
  for (const double degrees : kOutsideCone) {
    const DistributionErrors d = swap_distribution_errors<double>(degrees),
                             f = swap_distribution_errors<float>(degrees);
    take_larger(in_double, d.x, d.y);
    take_larger(in_float, f.x, f.y);
  }
  CAPTURE(in_double.x, in_double.y, in_float.x, in_float.y);
  CHECK(in_double.x <= BeckmannAnalyticMethod::kError);
  CHECK(in_float.x <= BeckmannAnalyticMethod::kError);
  CHECK(in_double.y <= kConditionalError);
  CHECK(in_float.y <= BeckmannAnalyticMethod::kError);
}

TEST_CASE("analytic Beckmann: what a swap leaves of u2 gives slope_y") {
  constexpr double kRounding = 1e-12;
  // u1 of the middle interval, |x| < cot(theta).
  CHECK(rest_error(20, 0.5) <= kRounding);
  CHECK(rest_error(20, 0.9) <= kRounding);
  CHECK(rest_error(45, 0.95) <= kRounding);
}

TEST_CASE("analytic methods: the cone of normal incidence costs what the docstrings say") {
  const auto beckmann = distribution_errors<BeckmannForms>(
      BeckmannAnalytic<double>(), direction_at<double>(kInsideCone), Alpha<double>{1, 1});
  const auto ggx = distribution_errors<GgxForms>(
      GgxAnalytic<double>(), direction_at<double>(kInsideCone), Alpha<double>{1, 1});
  CHECK(beckmann.x == Approx(BeckmannAnalyticMethod::kConeError).margin(kPairError));
  CHECK(ggx.x == Approx(GgxAnalyticMethod::kConeError).margin(kPairError));
  // At the pole itself it costs nothing.
  const auto pole = distribution_errors<GgxForms>(GgxAnalytic<double>(), Vec3<double>{0, 0, 1},
                                                  Alpha<double>{1, 1});
  CHECK(pole.x <= kPairError);
  CHECK(pole.y <= kPairError);
}

TEST_CASE(
    "analytic methods: inside the cone slopes beyond cot(theta) are drawn, as rarely as stated") {
  const auto wi = direction_at<double>(kInsideCone);
  const double c = wi.z / wi.x;
  CHECK(c > 223);
  // Slopes exceed c along azimuth 0 with probability Q(c).
  CHECK(GgxForms::q(c) == Approx(1 / 2e5).epsilon(0.01));
  CHECK(BeckmannForms::q(c) == 0);
  CHECK(dot(wi, GgxAnalytic<double>().sample(wi, {1, 1}, 1 - 1e-6, 0)) < 0);
}

TEST_CASE("analytic GGX: slope_x is the quantile of u1 outside the cone, in double") {
  double worst = 0;
  for (const double degrees : kOutsideCone)
    worst = std::max(worst, map_errors<GgxForms>(GgxAnalytic<double>(),
                                                 direction_at<double>(degrees), Alpha<double>{1, 1})
                                .x);
  CHECK(worst <= GgxAnalyticMethod::kError);
}

TEST_CASE("analytic GGX: in float single u1 near G1 give slopes far off") {
  // Where A = 2 u1 / G1 - 1 is near 1.
  const GgxAnalytic<float> sampler;
  double worst = 0;
  for (double degrees = 0.26; degrees < 90; degrees += 0.37) {
    const auto wi = direction_at<float>(degrees);
    const VisibleDistribution<GgxForms> distribution(wi, Alpha<float>{1, 1});
    const float g1 = sampler.g1(wi, {1, 1});
    for (int k = -1000; k <= 1000; ++k) {
      const float u1 = g1 * (1 + static_cast<float>(k) * 0x1p-24f);
      if (u1 < 1)
        worst = std::max(
            worst, std::abs(distribution(sampler.sample(wi, {1, 1}, u1, 0.5f)).x - double{u1}));
    }
  }
  CHECK(worst <= GgxAnalyticMethod::kFloatMapError);
  CHECK(worst > GgxAnalyticMethod::kFloatMapError / 20);
}

TEST_CASE("analytic GGX: rounding to float keeps its stated error over all pairs") {
  double worst = 0;
  for (const double degrees : {0.5, 30.0, 60.0, 85.0, 90.0})
    for (const float alpha : {1.0f, 0.1f}) {
      const auto wi = direction_at<float>(degrees, 20);
      if (std::hypot(alpha * wi.x, alpha * wi.y) < 1e-2f * wi.z) continue;  // the cone's edge
      worst = std::max(worst, rounding_error<GgxForms>(GgxAnalytic<float>(), GgxAnalytic<double>(),
                                                       wi, Alpha<float>{alpha, alpha}));
    }
  CHECK(worst <= GgxAnalyticMethod::kFloatError);
}

TEST_CASE("analytic GGX: the rational fit of slope_y errs as stated and ends where stated") {
  double worst = 0;
  for (const double u2 : probe_numbers()) {
    const double z = GgxAnalyticMethod::sample_z(u2);
    worst = std::max(worst, std::abs(GgxForms::conditional(0, z) - u2));
  }
  CHECK(worst <= GgxAnalyticMethod::kFitError);
  CHECK(worst > GgxAnalyticMethod::kFitError - 1e-5);
  CHECK(GgxAnalyticMethod::sample_z(1.0) == Approx(GgxAnalyticMethod::kFitEnd).margin(1e-3));
  CHECK(GgxAnalyticMethod::sample_z(0.0) == -GgxAnalyticMethod::sample_z(1.0));
}

TEST_CASE("analytic GGX: slopes increase with u1 and u2 outside the cone, in double") {
  const GgxAnalytic<double> sampler;
  for (const double degrees : kOutsideCone) {
    const auto wi = direction_at<double>(degrees);
    double last_x = -INFINITY, last_y = -INFINITY;
    for (int k = 0; k <= 1000; ++k) {
      const auto x = slope_of(sampler.sample(wi, {1, 1}, k / 1000.0, 0.5)).x;
      const auto y = slope_of(sampler.sample(wi, {1, 1}, 0.5, k / 1000.0)).y;
      constexpr double kRounding = 1e-10;
      CAPTURE(degrees, k);
      REQUIRE(x >= last_x - kRounding * std::max(1.0, std::abs(x)));
      REQUIRE(y >= last_y);
      last_x = x;
      last_y = y;
    }
  }
}
