// Light from far away: where each texel is seen, and that directions are drawn with the density
// that is told. References are sums over texels, which do not use the sampler.
#include "render/environment.h"

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <vector>

#include "render/sky.h"
#include "support/catch.h"

using namespace vndf;
using namespace vndf::render;
using vndf::test::Approx;
using vndf::test::contains;

namespace {

constexpr double kPi = std::numbers::pi;
const float kLargestBelowOne = std::nextafter(1.0f, 0.0f);

Rgb grey(float value) {
  return {value, value, value};
}

/// An image of `width` columns.
Image image_of(std::size_t width, const std::vector<float>& greys) {
  Image image{width, greys.size() / width, {}};
  for (const float value : greys) image.pixels.push_back(grey(value));
  return image;
}

/// Some texels are black, a whole row and a whole column among them.
Image patchwork() {
  return image_of(5, {1,    0, 0.25f, 2, 3,     //
                      0,    0, 0,     0, 0,     //
                      0.5f, 0, 8,     1, 0.1f,  //
                      4,    0, 0,     0, 1,     //
                      1,    0, 1,     1, 1});
}

/// The sum of f over directions in the middle of `fine` x `fine` parts of each texel of an image,
/// weighted by solid angle.
double integral(std::size_t width, std::size_t height, std::size_t fine,
                const std::function<double(const Vector&)>& f) {
  const std::size_t rows = fine * height, columns = fine * width;
  double sum = 0;
  for (std::size_t i = 0; i < rows; ++i) {
    const double step = kPi / static_cast<double>(rows);
    const double angle = step * (static_cast<double>(i) + 0.5);
    const double height_of_row = 2 * std::sin(angle) * std::sin(step / 2);
    for (std::size_t k = 0; k < columns; ++k) {
      const double turn =
          2 * kPi * ((static_cast<double>(k) + 0.5) / static_cast<double>(columns) - 0.5);
      sum += height_of_row * 2 * kPi / static_cast<double>(columns) *
             f({static_cast<float>(std::sin(angle) * std::sin(turn)),
                static_cast<float>(std::sin(angle) * std::cos(turn)),
                static_cast<float>(std::cos(angle))});
    }
  }
  return sum;
}

double luminance_from(const Environment& e, const Vector& w) {
  return static_cast<double>(luminance(e.radiance(w)));
}

}  // namespace

TEST_CASE("constant surroundings have their radiance and one density everywhere") {
  const Environment e = Environment::constant({0.3f, 1, 0.7f});
  const auto density = static_cast<float>(1 / (4 * kPi));
  for (const Vector& w : {Vector{0, 0, 1}, Vector{0, 0, -1}, Vector{1, 0, 0}, Vector{0, -1, 0},
                          Vector{-0.6f, 0.64f, 0.48f}}) {
    CHECK(e.radiance(w).r == 0.3f);
    CHECK(e.radiance(w).g == 1);
    CHECK(e.radiance(w).b == 0.7f);
    CHECK(e.pdf(w) == density);
  }
  const Environment::Sample drawn = e.sample(0.25f, 0.75f);
  CHECK(drawn.pdf == density);
  CHECK(drawn.w.z == 0.5f);
  CHECK(drawn.w.x == Approx(std::sqrt(0.75)));
}

TEST_CASE("columns go around from behind, over the left, the front and the right") {
  const Environment e(image_of(4, {1, 2, 3, 4}));
  const float d = std::sqrt(0.5f);
  CHECK(e.radiance({-d, -d, 0}).r == 1);
  CHECK(e.radiance({-d, d, 0}).r == 2);
  CHECK(e.radiance({d, d, 0}).r == 3);
  CHECK(e.radiance({d, -d, 0}).r == 4);
}

TEST_CASE("rows go from the zenith to the nadir in steps of equal angle, poles included") {
  const Environment e(image_of(1, {1, 2, 3, 4}));
  CHECK(e.radiance({0, 0, 1}).r == 1);
  CHECK(e.radiance({0, 0, -1}).r == 4);
  const auto at = [&](float degrees) {
    const float angle = degrees * std::numbers::pi_v<float> / 180;
    return e.radiance({0, std::sin(angle), std::cos(angle)}).r;
  };
  CHECK(at(44.9f) == 1);
  CHECK(at(45.1f) == 2);
  CHECK(at(89.9f) == 2);
  CHECK(at(90.1f) == 3);
  CHECK(at(134.9f) == 3);
  CHECK(at(135.1f) == 4);
}

TEST_CASE("the density integrates to 1 and is in proportion to luminance") {
  const Environment e(patchwork());
  CHECK(integral(5, 5, 7, [&](const Vector& w) { return e.pdf(w); }) == Approx(1).epsilon(1e-6));
  const double flux = integral(5, 5, 7, [&](const Vector& w) { return luminance_from(e, w); });
  integral(5, 5, 3, [&](const Vector& w) {
    CHECK(static_cast<double>(e.pdf(w)) == Approx(luminance_from(e, w) / flux).epsilon(1e-6));
    return 0.0;
  });
}

TEST_CASE("colours are sampled by their luminance") {
  const Environment e(Image{2, 1, {{1, 0, 0}, {0, 1, 0}}});
  CHECK(e.pdf({1, 0, 0}) / e.pdf({-1, 0, 0}) == Approx(0.7152 / 0.2126));
}

TEST_CASE("sampled directions are counted as their density says") {
  const Environment e(patchwork());
  constexpr std::size_t kFine = 3, kSide = 5 * kFine;
  constexpr int kSamples = 1'000'000;
  std::vector<int> counts(kSide * kSide);
  std::mt19937 random(1);
  const auto uniform = [&] { return static_cast<float>(random() >> 8) * 0x1p-24f; };
  const auto bin = [](const Vector& w) {
    const auto index = [](double share) { return static_cast<std::size_t>(share * kSide); };
    const double angle = std::acos(static_cast<double>(w.z));
    const double turn = std::atan2(static_cast<double>(w.x), static_cast<double>(w.y));
    return index(angle / kPi) * kSide + index(turn / (2 * kPi) + 0.5);
  };
  for (int i = 0; i < kSamples; ++i) {
    const float u1 = uniform(), u2 = uniform();
    ++counts[bin(e.sample(u1, u2).w)];
  }
  double chi_square = 0;
  int bins = 0;
  integral(5, 5, kFine, [&](const Vector& w) {
    const double angle = std::acos(static_cast<double>(w.z)), step = kPi / kSide;
    const double solid_angle = 2 * std::sin(angle) * std::sin(step / 2) * 2 * kPi / kSide;
    const double expected = static_cast<double>(e.pdf(w)) * solid_angle * kSamples;
    const double off = counts[bin(w)] - expected;
    if (expected > 0) {
      chi_square += off * off / expected;
      ++bins;
    } else {
      CHECK(off == 0);
    }
    return 0.0;
  });
  // Five standard deviations, which chance exceeds about once in a million.
  CHECK(chi_square < bins - 1 + 5 * std::sqrt(2.0 * (bins - 1)));
}

TEST_CASE("a sample tells the radiance and the density of its direction") {
  const Environment e(patchwork());
  std::mt19937 random(2);
  const auto uniform = [&] { return static_cast<float>(random() >> 8) * 0x1p-24f; };
  int elsewhere = 0;
  for (int i = 0; i < 100'000; ++i) {
    const float u1 = uniform(), u2 = uniform();
    const auto drawn = e.sample(u1, u2);
    CHECK(length(drawn.w) == Approx(1).epsilon(3e-7));
    // Directions at the edge of a texel are rounded to the next one.
    if (drawn.pdf != e.pdf(drawn.w) || drawn.radiance.r != e.radiance(drawn.w).r) ++elsewhere;
  }
  CHECK(elsewhere < 10);
}

TEST_CASE("the ends of both random numbers give light from unit directions") {
  for (const Environment& e :
       {Environment::constant({1, 1, 1}), Environment(patchwork()), Environment::sky()})
    for (const float u1 : {0.0f, std::numeric_limits<float>::denorm_min(), kLargestBelowOne})
      for (const float u2 : {0.0f, std::numeric_limits<float>::denorm_min(), kLargestBelowOne}) {
        const auto drawn = e.sample(u1, u2);
        CHECK(length(drawn.w) == Approx(1).epsilon(3e-7));
        CHECK(drawn.pdf > 0);
        CHECK(std::isfinite(drawn.pdf));
        CHECK(drawn.radiance.g > 0);
      }
}

TEST_CASE("all samples go to the only bright texel") {
  std::vector<float> greys(64 * 32);
  constexpr std::size_t kRow = 5, kColumn = 40;
  greys[kRow * 64 + kColumn] = 1e30f;
  const Environment e(image_of(64, greys));
  const double solid_angle =
      2 * kPi / 64 * (std::cos(kPi * kRow / 32.0) - std::cos(kPi * (kRow + 1) / 32.0));
  for (const float u1 : {0.0f, 0.3f, kLargestBelowOne})
    for (const float u2 : {0.0f, 0.6f, kLargestBelowOne}) {
      const auto drawn = e.sample(u1, u2);
      CHECK(static_cast<double>(drawn.pdf) * solid_angle == Approx(1).epsilon(1e-6));
      CHECK(drawn.radiance.r == 1e30f);
    }
  CHECK(e.pdf({0, 0, -1}) == 0);
}

TEST_CASE("black surroundings are sampled evenly") {
  const Environment e(image_of(2, {0, 0, 0, 0}));
  CHECK(e.sample(0.1f, 0.2f).pdf == static_cast<float>(1 / (4 * kPi)));
  CHECK(e.sample(0.1f, 0.2f).radiance.r == 0);
}

TEST_CASE("the irradiance of samples is that of the image") {
  const Vector normal{0.48f, -0.6f, 0.64f};
  const auto cosine = [&](const Vector& w) { return std::max(0.0f, dot(normal, w)); };
  const auto check = [&](const Environment& e, std::size_t width, std::size_t height,
                         std::size_t fine) {
    const double exact = integral(width, height, fine, [&](const Vector& w) {
      return luminance_from(e, w) * static_cast<double>(cosine(w));
    });
    constexpr std::uint32_t kSamples = 1 << 16;
    double sum = 0;
    for (std::uint32_t i = 0; i < kSamples; ++i) {
      // The additive recurrence of the plastic number (Roberts 2018).
      const auto u = [&](double step) {
        const double x = step * i;
        return static_cast<float>(x - std::floor(x)) * kLargestBelowOne;
      };
      const auto drawn = e.sample(u(0.7548776662466927), u(0.5698402909980532));
      sum += static_cast<double>(luminance(drawn.radiance) / drawn.pdf * cosine(drawn.w));
    }
    // So many points leave an error of about 5e-4.
    CHECK(sum / kSamples == Approx(exact).epsilon(2e-3));
  };
  check(Environment(patchwork()), 5, 5, 40);
  check(Environment::sky(), 1024, 512, 1);
}

TEST_CASE("the sun of the sky gives three times the light of the rest") {
  const Environment e = Environment::sky();
  const auto radian = [](double degrees) { return degrees * kPi / 180; };
  const double height = radian(40), azimuth = radian(220);
  const Vector sun{static_cast<float>(std::cos(height) * std::cos(azimuth)),
                   static_cast<float>(std::cos(height) * std::sin(azimuth)),
                   static_cast<float>(std::sin(height))};
  const auto irradiance = [&](bool of_sun) {
    return integral(1024, 512, 1, [&](const Vector& w) {
      const bool in_sun = dot(w, sun) > std::cos(4.5f * std::numbers::pi_v<float> / 180);
      return in_sun == of_sun ? luminance_from(e, w) * static_cast<double>(std::max(0.0f, w.z))
                              : 0.0;
    });
  };
  CHECK(irradiance(true) / irradiance(false) == Approx(3).epsilon(0.02));
  const double flux = integral(1024, 512, 1, [&](const Vector& w) { return luminance_from(e, w); });
  CHECK(flux / (4 * kPi) == Approx(0.62).epsilon(0.05));
  CHECK(e.radiance({0, 1, 0.01f}).b > e.radiance({0, 0, 1}).b);
  CHECK(e.radiance({0, 0, 1}).b > 2 * e.radiance({0, 0, 1}).r);
  CHECK(e.radiance({0, 0, -1}).g == 0.2f);
}

TEST_CASE("the largest number is light") {
  const Environment e(image_of(1, {std::numeric_limits<float>::max()}));
  CHECK(e.pdf({0, 0, 1}) == Approx(1 / (4 * kPi)));
}

TEST_CASE("images that are no light are refused") {
  CHECK_THROWS_AS(Environment(Image{}), std::invalid_argument);
  CHECK_THROWS_AS(Environment(Image{2, 1, {grey(1)}}), std::invalid_argument);
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (const float value : {-1e-6f, kInfinity, -kInfinity, std::numeric_limits<float>::quiet_NaN()})
    CHECK_THROWS_WITH(Environment(image_of(2, {1, value})), contains("negative or not finite"));
}
