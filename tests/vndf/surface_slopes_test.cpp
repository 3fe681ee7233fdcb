// Surfaces in the numbers that people give.
#include "vndf/surface_slopes.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "support/catch.h"

using namespace vndf;
using vndf::test::Approx;
using vndf::test::contains;

namespace {

// Five roundings of double precision.
constexpr double kRounding = 1e-15;

void check_same(const RoughSurface<double>& a, const RoughSurface<double>& b) {
  CHECK(a.alpha().x == Approx(b.alpha().x).epsilon(kRounding));
  CHECK(a.alpha().y == Approx(b.alpha().y).epsilon(kRounding));
  CHECK(a.shear() == Approx(b.shear()).epsilon(kRounding).margin(kRounding));
}

}  // namespace

TEST_CASE("a surface of alpha alone is its flat surface, bit for bit") {
  const RoughSurface<float> surface = SurfaceSlopes{{0.3, 0.1}}.surface<float>();
  CHECK(surface.is_flat());
  CHECK(surface.alpha().x == 0.3f);
  CHECK(surface.alpha().y == 0.1f);
}

TEST_CASE("the roughness and the correlation of a turned surface give the turned surface") {
  for (const double degrees : {-75.0, -20.0, 10.0, 45.0, 100.0, 400.0}) {
    CAPTURE(degrees);
    const SurfaceSlopes slopes = turned({0.5, 0.2}, degrees);
    check_same(slopes.surface<double>(),
               RoughSurface<double>::turned({0.5, 0.2}, degrees * std::numbers::pi / 180));
  }
}

TEST_CASE("half turns change nothing, and quarter turns exchange the roughness exactly") {
  for (const double degrees : {0.0, 180.0, -180.0, 720.0})
    CHECK(turned({0.3, 0.1}, degrees) == SurfaceSlopes{{0.3, 0.1}});
  for (const double degrees : {90.0, -90.0, 270.0})
    CHECK(turned({0.3, 0.1}, degrees) == SurfaceSlopes{{0.1, 0.3}});
}

TEST_CASE("in single precision a correlation near 1 keeps its digits") {
  // 1 - c rounded to single precision first would be 1.2e-7 in place of 1e-7.
  const double correlation = 1 - 1e-7;
  const RoughSurface<float> surface = SurfaceSlopes{{1, 1}, correlation}.surface<float>();
  const double exact = std::sqrt((1 - correlation) * (1 + correlation));
  CHECK(surface.alpha().y == Approx(exact).epsilon(6e-8));  // half a unit of single precision
}

TEST_CASE("numbers that are no surface break a rule that is named") {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(check(SurfaceSlopes{{0.3, 0.1}, -0.99, {-5, 7}}));
  for (const double alpha : {0.0, -1.0, kInf, kNan}) {
    CHECK_THAT(check(SurfaceSlopes{{alpha, 1}}).value_or(""), contains("alpha"));
    CHECK_THAT(check(SurfaceSlopes{{1, alpha}}).value_or(""), contains("alpha"));
  }
  for (const double correlation : {-1.0, 1.0, 2.0, kNan})
    CHECK_THAT(check(SurfaceSlopes{{1, 1}, correlation}).value_or(""), contains("correlation"));
  for (const double mean : {kInf, -kInf, kNan}) {
    CHECK_THAT(check(SurfaceSlopes{{1, 1}, 0, {mean, 0}}).value_or(""), contains("mean"));
    CHECK_THAT(check(SurfaceSlopes{{1, 1}, 0, {0, mean}}).value_or(""), contains("mean"));
  }
}

TEST_CASE("a surface so long that its correlation rounds to 1 is refused") {
  CHECK_THAT(check(turned({1, 1e-9}, 45)).value_or(""), contains("correlation"));
}

TEST_CASE("the text of a surface reads back as the same numbers, bit for bit") {
  const SurfaceSlopes slopes{{1.0 / 3, 1e-9}, -0.1, {std::sqrt(2.0), -1e-310}};
  CHECK(text_of({{0.25, 1}, -0.5, {0, -2}}) == "0.25 1 -0.5 0 -2");
  CHECK(surface_slopes_of(text_of(slopes)) == slopes);
}

TEST_CASE("a text that is not the numbers of a surface is none") {
  REQUIRE(surface_slopes_of("1 1 0 0 0"));
  for (const char* text : {"", "1 1 0 0", "1 1 0 0 0 0", "1 1 0 0 0 ", " 1 1 0 0 0", "1  1 0 0 0",
                           "1 1 0 0 x", "1,1,0,0,0", "0 1 0 0 0", "1 -1 0 0 0", "1 1 1 0 0",
                           "1 1 0 inf 0", "1 1 0 0 nan", "1 1 0 0 1e999"}) {
    CAPTURE(text);
    CHECK_FALSE(surface_slopes_of(text));
  }
}
