// The sampler and the functions beside it: the map, its invariants, its edges, against closed
// forms.
#include "vndf/tabulated_sampler.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "support/built_tables.h"
#include "support/catch.h"
#include "support/closed_forms.h"
#include "support/directions.h"
#include "support/random_inputs.h"
#include "support/slope_midpoints.h"
#include "support/stated_results.h"
#include "support/tolerances.h"
#include "vndf/bsdf/normal_sampler.h"

using namespace vndf;
using namespace vndf::test;

namespace {

static_assert(NormalSampler<TabulatedSampler<float>, float>);
static_assert(NormalSampler<TabulatedSampler<double>, double>);

constexpr float kJustBelowOne = 1 - 0x1p-24f;

template <class T>
TabulatedSampler<T> sampler_of(const std::string& distribution) {
  return TabulatedSampler<T>(large_tables(distribution).tables);
}

/// Largest of |CDF - u| for the slopes of sample() at roughness `alpha`, by the closed forms.
template <class T, class Forms>
double worst_u_error(double degrees, double alpha) {
  const auto sampler = sampler_of<T>(Forms::name);
  const Vec3<T> wi = direction_at<T>(degrees);
  const double cosine = double{wi.z}, sine = double{wi.x} * alpha;
  double worst = 0;
  for (int i = 1; i < 60; ++i)
    for (int j = 1; j < 60; ++j) {
      const T u1 = static_cast<T>(i) / 60, u2 = static_cast<T>(j) / 60;
      const Vec3<T> m = sampler.sample(wi, {static_cast<T>(alpha), static_cast<T>(alpha)}, u1, u2);
      const double x = -double{m.x} / m.z / alpha, y = -double{m.y} / m.z / alpha;
      worst = std::max(worst, std::abs(visible_cdf<Forms>(cosine, sine, x) - double{u1}));
      worst = std::max(worst, std::abs(Forms::conditional(x, y) - double{u2}));
    }
  return worst;
}

template <class T, class Forms>
void check_functions(double degrees, const Alpha<double>& alpha, double bound) {
  const auto sampler = sampler_of<T>(Forms::name);
  const Alpha<T> a{static_cast<T>(alpha.x), static_cast<T>(alpha.y)};
  const Vec3<T> w = direction_at<T>(degrees, 30);
  const double ax = a.x, ay = a.y;
  const double c = double{w.z} / std::hypot(ax * w.x, ay * w.y);
  const double lambda = Forms::lambda(c);
  CAPTURE(Forms::name, degrees, alpha.x, alpha.y, sizeof(T));
  CHECK(std::abs(double{sampler.lambda(w, a)} - lambda) <= bound * (1 + lambda));
  CHECK(double{sampler.g1(w, a)} == Approx(1 / (1 + lambda)).epsilon(bound));

  for (const double tilt : {0.0, 5.0, 30.0, 60.0}) {
    const Vec3<T> m = direction_at<T>(tilt, 200);
    // D of the stretched normal, of which the slope is divided by alpha.
    const double sx = m.x / ax / m.z, sy = m.y / ay / m.z;
    const double cosine = 1 / std::sqrt(1 + sx * sx + sy * sy);
    const double d = Forms::d(cosine) * std::pow(cosine / m.z, 4) / (ax * ay);
    CAPTURE(tilt);
    if (d < 1e-12) continue;
    CHECK(double{sampler.d(m, a)} == Approx(d).epsilon(bound));
    const double facing = std::max(0.0, double{w.x} * m.x + double{w.y} * m.y + double{w.z} * m.z);
    const double density = facing * d / (double{w.z} * (1 + lambda));
    CHECK(std::abs(double{sampler.pdf(w, m, a)} - density) <=
          bound * d / (double{w.z} * (1 + lambda)));
  }
}

}  // namespace

TEST_CASE("slope_x is the visible quantile of u1 and slope_y the conditional quantile of u2") {
  for (const double degrees : {0.0, 1.0, 30.0, 60.0, 85.0, 89.9})
    for (const double alpha : {0.01, 1.0, 5.0}) {
      CAPTURE(degrees, alpha);
      CHECK(worst_u_error<float, GgxForms>(degrees, alpha) <= kLargeTableUError);
      CHECK(worst_u_error<float, BeckmannForms>(degrees, alpha) <= kLargeTableUError);
      CHECK(worst_u_error<double, GgxForms>(degrees, alpha) <= kLargeTableUError);
      CHECK(worst_u_error<double, BeckmannForms>(degrees, alpha) <= kLargeTableUError);
    }
}

TEST_CASE("D, Lambda, G1 and pdf equal the closed forms at any roughness and incidence") {
  for (const double degrees : {0.0, 0.001, 10.0, 45.0, 80.0, 89.9, 89.99999})
    for (const Alpha<double> alpha : {Alpha<double>{1, 1}, {0.1, 0.5}, {3, 0.05}}) {
      check_functions<float, GgxForms>(degrees, alpha, kFunctionError);
      check_functions<float, BeckmannForms>(degrees, alpha, kFunctionError);
      check_functions<double, GgxForms>(degrees, alpha, kFunctionErrorInDouble);
      check_functions<double, BeckmannForms>(degrees, alpha, kFunctionErrorInDouble);
    }
}

TEST_CASE("D projects to area 1 and pdf integrates to 1") {
  for (const char* name : {"ggx", "beckmann"}) {
    const auto sampler = sampler_of<double>(name);
    for (const Alpha<double> alpha : {Alpha<double>{1, 1}, {0.2, 0.05}}) {
      CAPTURE(name, alpha.x, alpha.y);
      const auto projected = [&](const Vec3<double>& m) { return sampler.d(m, alpha) * m.z; };
      CHECK(over_slopes(projected, alpha) == Approx(1).margin(2e-5));
      for (const double degrees : {0.0, 40.0, 75.0}) {
        const auto wi = direction_at<double>(degrees, 60);
        const auto pdf = [&](const Vec3<double>& m) { return sampler.pdf(wi, m, alpha); };
        CHECK(over_slopes(pdf, alpha) == Approx(1).margin(1e-3));  // a kink where wi grazes m
      }
    }
  }
}

TEST_CASE("anisotropy is a stretch: the azimuth of the stretched direction turns the slopes") {
  // At alpha_x = alpha_y the map turns with wi.
  const auto sampler = sampler_of<double>("ggx");
  const auto straight = sampler.sample(direction_at<double>(50, 0), {0.4, 0.4}, 0.3, 0.8);
  const auto turned = sampler.sample(direction_at<double>(50, 70), {0.4, 0.4}, 0.3, 0.8);
  const double cosine = std::cos(70 * kDegree), sine = std::sin(70 * kDegree);
  CHECK(turned.x == Approx(cosine * straight.x - sine * straight.y).margin(1e-14));
  CHECK(turned.y == Approx(sine * straight.x + cosine * straight.y).margin(1e-14));
  CHECK(turned.z == Approx(straight.z).margin(1e-14));
}

TEST_CASE("slope_x increases with u1 from -infinity to cot(theta), slope_y with u2") {
  const auto sampler = sampler_of<float>("ggx");
  for (const double degrees : {0.0, 20.0, 60.0, 89.0}) {
    const auto wi = direction_at<float>(degrees);
    Vec2<float> last_x{-INFINITY, 0}, last_y{0, -INFINITY};
    for (int k = 0; k <= 3000; ++k) {
      const float u = static_cast<float>(k) / 3000;
      const auto x = slope_of(sampler.sample(wi, {1, 1}, u, 0.5f));
      const auto y = slope_of(sampler.sample(wi, {1, 1}, 0.5f, u));
      constexpr float kRounding = 1e-6f;
      REQUIRE(x.x >= last_x.x - kRounding * std::abs(x.x));
      REQUIRE(y.y >= last_y.y - kRounding * std::abs(y.y));
      last_x = x;
      last_y = y;
    }
    CHECK(slope_of(sampler.sample(wi, {1, 1}, 0, 0.5f)).x == -INFINITY);
    // The end of a row is rounded by 2^-25, which the map of GGX multiplies by 2.2 and the slope by
    // another 4 near 0; the components of the normal are rounded by as much together.
    constexpr double kEnd = 2 * 8.8 * 0x1p-25;
    if (degrees > 0) CHECK(last_x.x == Approx(wi.z / wi.x).epsilon(1e-6).margin(kEnd));
  }
}

TEST_CASE("along an azimuth the map is continuous up to normal incidence") {
  // The exact derivative of F at the pole: dx = tan(theta) M(x) / P(x), so a step of tan(theta)
  // moves the slope by about as much; a cone treated as the pole would leave a jump of 1e-3.
  constexpr double kPoleRounding = 2e-7;  // of values stored in single precision
  const auto sampler = sampler_of<double>("ggx");
  const auto at_pole = sampler.sample({0, 0, 1}, {1, 1}, 0.3, 0.6);
  for (const double degrees : {1e-12, 1e-6, 1e-3, 0.1, 0.2563}) {
    const auto near = sampler.sample(direction_at<double>(degrees), {1, 1}, 0.3, 0.6);
    const double moved = slope_of(near).x - slope_of(at_pole).x;
    const double x = slope_of(at_pole).x;
    const double expected = -std::tan(degrees * kDegree) * GgxForms::m(x) / GgxForms::p(x);
    CAPTURE(degrees);
    CHECK(moved == Approx(expected).epsilon(0.02).margin(kPoleRounding));
  }
}

TEST_CASE("a direction too close to the pole to square keeps its azimuth") {
  const auto sampler = sampler_of<float>("ggx");
  const auto along_y = sampler.sample({0, 1e-30f, 1}, {0.5f, 0.5f}, 0.2f, 0.5f);
  const auto along_y_far = sampler.sample({0, 1e-6f, 1}, {0.5f, 0.5f}, 0.2f, 0.5f);
  CHECK(along_y.y == Approx(along_y_far.y).epsilon(1e-5));
  CHECK(std::abs(along_y.x) < 1e-6f);
}

TEST_CASE("the map is continuous in every argument") {
  const auto sampler = sampler_of<double>("beckmann");
  RandomInputs inputs(3);
  constexpr double kStep = 1e-9, kMostSlope = 1e3;
  for (int k = 0; k < 2000; ++k) {
    const double degrees = 1 + 88 * inputs.uniform(), phi = 360 * inputs.uniform();
    const double ax = 0.1 + inputs.uniform(), ay = 0.1 + inputs.uniform();
    const double u1 = 0.01 + 0.98 * inputs.uniform(), u2 = 0.01 + 0.98 * inputs.uniform();
    const auto at = [&](double dt, double dp, double da, double d1, double d2) {
      return sampler.sample(direction_at<double>(degrees + dt, phi + dp), {ax + da, ay}, u1 + d1,
                            u2 + d2);
    };
    const auto m = at(0, 0, 0, 0, 0);
    for (const auto& n : {at(kStep, 0, 0, 0, 0), at(0, kStep, 0, 0, 0), at(0, 0, kStep, 0, 0),
                          at(0, 0, 0, kStep, 0), at(0, 0, 0, 0, kStep)})
      REQUIRE(std::hypot(n.x - m.x, n.y - m.y, n.z - m.z) < kMostSlope * kStep);
  }
}

TEST_CASE("the corners of u give finite unit normals that face wi") {
  const std::vector<float> corners{0, 0x1p-149f, 0x1p-24f, 0.5f, kJustBelowOne, 1};
  for (const char* name : {"ggx", "beckmann"}) {
    const auto sampler = sampler_of<float>(name);
    for (const double degrees : {0.0, 1e-7, 45.0, 89.9999999, 90.0})
      for (const Alpha<float> alpha : {Alpha<float>{1, 1}, {1e-4f, 0.1f}, {10, 1e-2f}})
        for (const float u1 : corners)
          for (const float u2 : corners) {
            Vec3<float> wi = direction_at<float>(degrees, 33);
            wi.z = std::max(wi.z, 0.0f);
            const auto m = sampler.sample(wi, alpha, u1, u2);
            CAPTURE(name, degrees, alpha.x, alpha.y, u1, u2, m.x, m.y, m.z);
            REQUIRE(finite_unit(m));
            REQUIRE(dot(wi, m) >= -kFacingSlack<float>);
            REQUIRE(sampler.pdf(wi, m, alpha) >= 0);
            REQUIRE_FALSE(std::isnan(sampler.pdf(wi, m, alpha)));
          }
  }
}

TEST_CASE("an input outside its range gives the stated result") {
  check_stated_results(sampler_of<float>("ggx"));
}

TEST_CASE(
    "masking below the horizon is that of the mirrored direction; at the horizon all is hidden") {
  const auto sampler = sampler_of<double>("beckmann");
  const auto above = direction_at<double>(50), below = Vec3<double>{above.x, above.y, -above.z};
  CHECK(sampler.lambda(above, {1, 1}) == sampler.lambda(below, {1, 1}));
  CHECK(sampler.g1(above, {1, 1}) == sampler.g1(below, {1, 1}));
  CHECK(sampler.lambda({1, 0, 0}, {1, 1}) == INFINITY);
  CHECK(sampler.g1({1, 0, 0}, {1, 1}) == 0);
  CHECK(sampler.g1({0, 0, 1}, {1, 1}) == 1);
  CHECK(sampler.lambda({0, 0, 1}, {1, 1}) == 0);
}

TEST_CASE("the density stays finite at the horizon") {
  const auto sampler = sampler_of<float>("ggx");
  const Vec3<float> horizon{1, 0, 0}, wm = direction_at<float>(45);
  // G1 / wi.z tends to 1 / (sin(theta) M(0)) = 2 for GGX.
  CHECK(sampler.pdf(horizon, wm, {1, 1}) ==
        Approx(2 * dot(horizon, wm) / std::numbers::pi).epsilon(1e-6));
}

namespace {

void check_hard_inputs(int count, std::uint64_t seed) {
  const auto ggx = sampler_of<float>("ggx"), beckmann = sampler_of<float>("beckmann");
  RandomInputs inputs(seed);
  float lowest = 0;
  for (int k = 0; k < count; ++k) {
    const SamplerInput in = inputs.hard_anywhere();
    const auto f = [](double v) { return static_cast<float>(v); };
    const Vec3<float> wi{f(in.wi.x), f(in.wi.y), f(in.wi.z)};
    const Alpha<float> alpha{f(in.alpha.x), f(in.alpha.y)};
    for (const auto* sampler : {&ggx, &beckmann}) {
      const auto m = sampler->sample(wi, alpha, f(in.u1), f(in.u2));
      const float pdf = sampler->pdf(wi, m, alpha);
      lowest = std::min(lowest, dot(wi, m));
      if (finite_unit(m) && dot(wi, m) >= -kFacingSlack<float> && pdf >= 0) continue;
      CAPTURE(k, wi.x, wi.y, wi.z, alpha.x, alpha.y, in.u1, in.u2, m.x, m.y, m.z, pdf, dot(wi, m));
      FAIL("not a finite unit normal facing wi");
    }
  }
  WARN("lowest dot(wi, wm) of " << count << ": " << lowest);
}

}  // namespace

TEST_CASE("hard random inputs give finite unit normals that face wi") {
  check_hard_inputs(200000, 5);
}

TEST_CASE("1e7 hard random inputs give finite unit normals that face wi", "[.slow]") {
  check_hard_inputs(10000000, std::random_device{}());
}
