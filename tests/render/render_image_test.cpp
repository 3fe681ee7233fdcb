// Whole images: light that is known in closed form, the white furnace, and estimates without bias.
#include "render/render_image.h"

#include <algorithm>
#include <atomic>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "render/scenes.h"
#include "support/baked_tables.h"
#include "support/catch.h"
#include "support/tolerances.h"

using namespace vndf;
using namespace vndf::render;
using namespace vndf::test;

namespace {

constexpr Sampling kAll[]{Sampling::previous, Sampling::walter, Sampling::visible};

std::shared_ptr<const Surface> tables_of(const std::string& distribution, Sampling sampling) {
  return tabulated_surface(std::make_shared<const KernelTables>(baked_tables(distribution)),
                           sampling);
}

/// Matt ground in grey surroundings, seen from above.
Scene grey_ground(float radiance) {
  return {.camera = {.position = {0, -1, 3}, .target = {0, 0, 0}},
          .environment = Environment::constant({radiance, radiance, radiance}),
          .bodies = {{rectangle({-50, -50, 0}, {100, 0, 0}, {0, 100, 0}),
                      std::make_shared<Matt>(Rgb{0.5f, 0.5f, 0.5f})}}};
}

/// The share of the light of a point at height h below the corner of a rectangle a x b that looks
/// down on it, for a matt receiver that looks up (Howell, catalogue of view factors, B-4).
double view_factor_of_corner(double a, double b, double h) {
  const double x = a / h, y = b / h, p = std::sqrt(1 + x * x), q = std::sqrt(1 + y * y);
  return (x / p * std::atan(y / p) + y / q * std::atan(x / q)) / (2 * std::numbers::pi);
}

/// The values of the green channel of `count` images with different seeds: what each pixel was.
std::vector<std::vector<double>> repeated(const Scene& scene, RenderOptions options,
                                          std::size_t count) {
  std::vector<std::vector<double>> values(options.width * options.height);
  for (std::size_t k = 0; k < count; ++k) {
    ++options.seed;
    const Image image = render::render(scene, options).image;
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i].push_back(static_cast<double>(image.pixels[i].g));
  }
  return values;
}

struct Moments {
  double mean = 0, variance_of_mean = 0;
};

Moments moments(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  double mean = 0, squares = 0;
  for (const double v : values) mean += v / n;
  for (const double v : values) squares += (v - mean) * (v - mean);
  return {mean, squares / (n - 1) / n};
}

/// The probability that two numbers with the same mean are found as far apart (Welch's t-test).
double chance(const Moments& a, const Moments& b, std::size_t count) {
  const double variance = a.variance_of_mean + b.variance_of_mean;
  const double difference = std::abs(a.mean - b.mean);
  if (variance < 1e-12) return difference < 1e-5 ? 1 : 0;  // beside the body nothing varies
  const double freedom =
      static_cast<double>(count - 1) * variance * variance /
      (a.variance_of_mean * a.variance_of_mean + b.variance_of_mean * b.variance_of_mean);
  const boost::math::students_t t(freedom);
  return 2 * boost::math::cdf(boost::math::complement(t, difference / std::sqrt(variance)));
}

/// The probability that images with the same means are found to differ as much: Fisher's
/// combination of the tests of all pixels.
double chance(const std::vector<std::vector<double>>& a,
              const std::vector<std::vector<double>>& b) {
  double sum = 0;
  std::size_t pixels = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double p = chance(moments(a[i]), moments(b[i]), a[i].size());
    if (p == 0) return 0;
    if (p == 1) continue;  // nothing varies
    sum -= 2 * std::log(p);
    ++pixels;
  }
  const boost::math::chi_squared law(2 * static_cast<double>(pixels));
  return boost::math::cdf(boost::math::complement(law, sum));
}

/// Light that differs with direction, so that a wrong direction shows, but without a sun. Paths
/// find that so seldom that the means of 32 repetitions are not normally distributed.
Environment cloudy() {
  Image image{4, 4, {}};
  for (const float value : {2.0f, 2.0f, 2.0f, 2.0f, 1.0f, 3.0f, 0.5f, 2.0f,  //
                            0.2f, 0.6f, 0.3f, 0.1f, 0.1f, 0.1f, 0.1f, 0.1f})
    image.pixels.push_back({value, value, value});
  return Environment(image);
}

const RenderOptions kSmall{.width = 12, .height = 12, .samples = 16};

}  // namespace

TEST_CASE("matt ground in grey surroundings is as bright as its albedo says", "[render]") {
  // Without sampled lights every path finds the surroundings, with the same result.
  const Image found =
      render::render(grey_ground(0.8f),
                     {.width = 4, .height = 4, .samples = 4, .sample_lights = false})
          .image;
  for (const Rgb& p : found.pixels) CHECK(p.g == Approx(0.4f).epsilon(1e-4));
  const Image sampled =
      render::render(grey_ground(0.8f), {.width = 2, .height = 2, .samples = 1 << 14}).image;
  for (const Rgb& p : sampled.pixels) CHECK(p.g == Approx(0.4f).epsilon(0.01));
}

TEST_CASE("a lamp lights the ground as its view factor says, with and without sampled lights",
          "[render]") {
  Scene scene = grey_ground(0);
  scene.camera = {.position = {0, 0.001f, 0.5f}, .target = {0, 0, 0}, .degrees = 0.1f};
  scene.lamp = Lamp{{-1, -0.5f, 1.5f}, {0, 1, 0}, {2, 0, 0}, {3, 3, 3}};
  const double exact = 0.5 * 3 * 4 * view_factor_of_corner(1, 0.5, 1.5);
  for (const bool sample_lights : {true, false}) {
    const auto values = repeated(
        scene, {.width = 1, .height = 1, .samples = 4096, .sample_lights = sample_lights}, 16);
    const Moments m = moments(values[0]);
    CAPTURE(sample_lights, m.mean, exact);
    CHECK(std::sqrt(m.variance_of_mean) < 0.02 * exact);
    CHECK(std::abs(m.mean - exact) < 6 * std::sqrt(m.variance_of_mean));  // t of 15: 2e-5
  }
}

TEST_CASE("the back of a lamp is dark", "[render]") {
  Scene scene = grey_ground(0);
  scene.camera.position = {0, -1, 1};
  scene.lamp = Lamp{{-1, -0.5f, 1.5f}, {2, 0, 0}, {0, 1, 0}, {3, 3, 3}};
  const Image image = render::render(scene, {.width = 4, .height = 4, .samples = 64}).image;
  for (const Rgb& p : image.pixels) CHECK(p.g == 0);
}

TEST_CASE("light that many reflections bring is as bright as an integrating sphere says",
          "[render]") {
  // Inside a sphere of radius 1 every point lights every other equally. A point behind a small lamp
  // in the middle sees what was reflected at least once: albedo^2 a L / (A (1 - albedo)), where a
  // is the lamp's area and A that of the sphere.
  constexpr double kAlbedo = 0.7, kArea = 0.1 * 0.1, kRadiance = 100;
  const double exact =
      kAlbedo * kAlbedo * kArea * kRadiance / (4 * std::numbers::pi * (1 - kAlbedo));
  Mesh inside = revolved(half_circle(1, 0));
  for (Vector& n : inside.normals) n = -n;
  const auto a = static_cast<float>(kAlbedo);
  const Scene scene{
      .camera = {.position = {0.5f, 0, -0.3f}, .target = {0.4f, 0.1f, -1}, .degrees = 20},
      .environment = Environment::constant({0, 0, 0}),
      .bodies = {{inside, std::make_shared<Matt>(Rgb{a, a, a})}},
      .lamp = Lamp{{-0.05f, -0.05f, 0}, {0.1f, 0, 0}, {0, 0.1f, 0}, {100, 100, 100}}};
  const Image image = render::render(scene, {.width = 8, .height = 8, .samples = 4096}).image;
  double mean = 0;
  for (const Rgb& p : image.pixels) mean += static_cast<double>(p.g) / 64;
  // The lamp absorbs what meets it, 0.16 % at each of 1 / (1 - albedo) reflections.
  CHECK(mean == Approx(exact).epsilon(0.015));
}

TEST_CASE("glass in white surroundings is never brighter than white", "[render][furnace]") {
  for (const char* name : {"plate", "plate-beckmann"}) {
    const std::string distribution = name == std::string("plate") ? "ggx" : "beckmann";
    const Scene scene = make_scene(name, *tables_of(distribution, Sampling::visible),
                                   {.environment = Environment::constant({1, 1, 1})});
    // Each path has a weight of at most 1, but for the rounding of about ten factors.
    const Image image =
        render::render(scene, {.width = 48, .height = 48, .samples = 32, .sample_lights = false})
            .image;
    double mean = 0;
    for (const Rgb& p : image.pixels) {
      REQUIRE(p.g <= 1.0001f);
      mean += static_cast<double>(p.g) / (48 * 48);
    }
    CAPTURE(name, mean);
    CHECK(mean < 0.9999);  // what a second bounce on the surface would return is lost
    CHECK(mean > 0.8);
  }
}

TEST_CASE("nearly smooth glass loses nothing", "[render][furnace]") {
  const Scene scene = make_scene(
      "plate", *tables_of("ggx", Sampling::visible),
      {.alpha = Alpha<float>{1e-3f, 1e-3f}, .environment = Environment::constant({1, 1, 1})});
  const Image image =
      render::render(scene, {.width = 24, .height = 24, .samples = 64, .sample_lights = false})
          .image;
  double mean = 0;
  for (const Rgb& p : image.pixels) mean += static_cast<double>(p.g) / (24 * 24);
  CHECK(mean == Approx(1).margin(2e-3));
}

TEST_CASE("every sampling of tables and of closed forms has the same mean in every pixel",
          "[render]") {
  struct Case {
    const char *scene, *distribution, *analytic;
  };
  for (const Case& c :
       {Case{"plate", "ggx", "ggx-caps"}, Case{"plate-beckmann", "beckmann", "beckmann-exact"},
        Case{"pedestal", "ggx", "ggx-exact"}}) {
    const SceneChoices rough{.alpha = Alpha<float>{0.2f, 0.4f}, .environment = cloudy()};
    RenderOptions options = kSmall;
    options.seed = 1000;
    options.samples = 64;
    const auto reference = repeated(
        make_scene(c.scene, *analytic_surface(c.analytic, Sampling::visible), rough), options, 32);
    for (const Sampling sampling : kAll)
      for (const auto& surface :
           {analytic_surface(c.analytic, sampling), tables_of(c.distribution, sampling)})
        for (const bool sample_lights : {true, false}) {
          options = kSmall;
          options.sample_lights = sample_lights;
          const auto values = repeated(make_scene(c.scene, *surface, rough), options, 32);
          CAPTURE(c.scene, static_cast<int>(sampling), sample_lights);
          CHECK(chance(values, reference) > kSignificance);
        }
  }
}

TEST_CASE("the comparison finds a surface that is a fifth rougher", "[render]") {
  const auto surface = analytic_surface("ggx-caps", Sampling::visible);
  const auto images = [&](float alpha, std::uint64_t seed) {
    RenderOptions options = kSmall;
    options.seed = seed;
    const SceneChoices choices{.alpha = Alpha<float>{alpha, 2 * alpha}, .environment = cloudy()};
    return repeated(make_scene("pedestal", *surface, choices), options, 32);
  };
  CHECK(chance(images(0.24f, 1), images(0.2f, 1000)) < kSignificance);
}

TEST_CASE("an image does not depend on the number of threads or on passes", "[render]") {
  const Scene scene = make_scene("ball", *analytic_surface("ggx-caps", Sampling::visible), {});
  RenderOptions options{.width = 16, .height = 9, .samples = 4, .workers = {.threads = 1}};
  const Image one = render::render(scene, options).image;
  options.workers.threads = 3;
  const Image three = render::render(scene, options).image;
  options.seconds = 0.05;
  const Rendering timed = render::render(scene, options);
  options.seconds = 0;
  options.samples = timed.samples;
  const Image same = render::render(scene, options).image;
  options.seed = 2;
  const Image other = render::render(scene, options).image;
  bool differs = false;
  for (std::size_t i = 0; i < one.pixels.size(); ++i) {
    CHECK(one.pixels[i].r == three.pixels[i].r);
    CHECK(timed.image.pixels[i].b == same.pixels[i].b);
    differs |= same.pixels[i].g != other.pixels[i].g;
  }
  CHECK(differs);
}

TEST_CASE("progress reaches the end", "[render]") {
  const Scene scene = make_scene("ball", *analytic_surface("ggx-caps", Sampling::visible), {});
  std::atomic<std::size_t> last = 0, whole = 1;
  RenderOptions options{.width = 4, .height = 4, .samples = 1};
  options.workers.progress = [&](std::size_t done, std::size_t count) {
    last = done;
    whole = count;
  };
  render::render(scene, options);
  CHECK(last == whole);
}

TEST_CASE("an image without pixels or samples is refused", "[render]") {
  const Scene scene = grey_ground(1);
  CHECK_THROWS_AS(render::render(scene, {.width = 0}), std::invalid_argument);
  CHECK_THROWS_AS(render::render(scene, {.samples = 0}), std::invalid_argument);
}
