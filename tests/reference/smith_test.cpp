// D, Lambda, G1 and pdf of the shapes in closed form: against the forms of the tests in long double
// precision where those cancel, and against quadrature.
#include "vndf/reference/smith.h"

#include "support/catch.h"
#include "support/closed_forms.h"
#include "support/hemisphere_integral.h"
#include "support/visible_normals.h"
#include "vndf/reference/beckmann.h"
#include "vndf/reference/beckmann_exact.h"
#include "vndf/reference/ggx.h"
#include "vndf/reference/ggx_exact.h"

using namespace vndf;
using namespace vndf::test;

namespace {

// Quadrature of functions with a kink, whose place rounding moves.
constexpr double kQuadratureError = 1e-6;

const std::vector<double> kDegrees{0, 1e-6, 0.1, 10, 45, 80, 89, 89.9, 89.99999};
const std::vector<Alpha<double>> kAlphas{{1, 1}, {0.1, 0.5}, {3, 0.05}, {1e-4, 0.1}, {10, 0.01}};

long double lambda(BeckmannShape, long double c) {
  constexpr long double kInverseSqrtPi = std::numbers::inv_sqrtpi_v<long double>;
  return (std::exp(-c * c) * kInverseSqrtPi / c - std::erfc(c)) / 2;
}
long double lambda(GgxShape, long double c) {
  return 1 / (2 * c * (c + std::hypot(1.0L, c)));
}

long double p22(BeckmannShape, long double square) {
  return std::exp(-square) * std::numbers::inv_pi_v<long double>;
}
long double p22(GgxShape, long double square) {
  return std::numbers::inv_pi_v<long double> / ((1 + square) * (1 + square));
}

template <class T, class Shape>
void check_masking() {
  const SmithSurface<T, Shape> surface;
  constexpr double kBound = Shape::kLambdaRoundings * std::numeric_limits<T>::epsilon();
  double worst = 0, worst_g1 = 0;
  for (const double degrees : kDegrees)
    for (const Alpha<double>& alpha : kAlphas) {
      const Vec3<T> w = direction_at<T>(degrees, 30);
      const Alpha<T> a{static_cast<T>(alpha.x), static_cast<T>(alpha.y)};
      const long double s =
          std::hypot(static_cast<long double>(a.x) * w.x, static_cast<long double>(a.y) * w.y);
      if (s == 0) continue;
      const double exact = static_cast<double>(lambda(Shape(), w.z / s));
      worst = std::max(worst, std::abs(double{surface.lambda(w, a)} - exact) / (1 + exact));
      worst_g1 = std::max(worst_g1, std::abs(double{surface.g1(w, a)} * (1 + exact) - 1));
    }
  CAPTURE(sizeof(T), worst, worst_g1, kBound);
  CHECK(worst <= kBound);
  CHECK(worst_g1 <= kBound);
}

template <class T, class Shape>
void check_density() {
  const SmithSurface<T, Shape> surface;
  constexpr double kBound = Shape::kDensityRoundings * std::numeric_limits<T>::epsilon();
  double worst = 0;
  for (const double degrees : {0.0, 1e-3, 1.0, 20.0, 60.0, 85.0, 89.5})
    for (const Alpha<double>& alpha : kAlphas) {
      const Vec3<T> m = direction_at<T>(degrees, 200);
      const Alpha<T> a{static_cast<T>(alpha.x), static_cast<T>(alpha.y)};
      using L = long double;
      const L z = m.z, x = L{m.x} / a.x / z, y = L{m.y} / a.y / z, square = x * x + y * y;
      if (square > 25) continue;
      const L exact = p22(Shape(), square) / (z * z * z * z * a.x * a.y);
      worst = std::max(worst, static_cast<double>(std::abs(surface.d(m, a) / exact - 1)));
    }
  CAPTURE(sizeof(T), worst, kBound);
  CHECK(worst <= kBound);
}

template <class Sampler>
void check_integrals() {
  const Sampler sampler;
  for (const Alpha<double>& alpha : {Alpha<double>{1, 1}, {0.2, 0.05}, {0.02, 2}}) {
    CAPTURE(alpha.x, alpha.y);
    const auto area = [&](const Vec3<double>& m) { return sampler.d(m, alpha) * m.z; };
    CHECK(over_normals(area, {0, 0, 1}, alpha) == Approx(1).margin(kQuadratureError));
    for (const double degrees : {0.0, 40.0, 75.0, 89.0}) {
      CAPTURE(degrees);
      const auto wi = direction_at<double>(degrees, 60);
      const auto pdf = [&](const Vec3<double>& m) { return sampler.pdf(wi, m, alpha); };
      CHECK(over_normals(pdf, wi, alpha) == Approx(1).margin(kQuadratureError));
    }
  }
}

}  // namespace

TEST_CASE("Lambda and G1 of Beckmann and GGX keep their stated errors from pole to horizon") {
  check_masking<float, BeckmannShape>();
  check_masking<double, BeckmannShape>();
  check_masking<float, GgxShape>();
  check_masking<double, GgxShape>();
}

TEST_CASE("D of Beckmann and GGX keeps its stated error to slopes of 5") {
  check_density<float, BeckmannShape>();
  check_density<double, BeckmannShape>();
  check_density<float, GgxShape>();
  check_density<double, GgxShape>();
}

TEST_CASE("D of Beckmann and GGX projects to area 1 and the visible pdf integrates to 1") {
  check_integrals<BeckmannExact<double>>();
  check_integrals<GgxExact<double>>();
}

TEST_CASE("the quadrature sees a pdf that is too large by 1e-5") {
  const GgxExact<double> sampler;
  const auto wi = direction_at<double>(75, 60);
  const auto pdf = [&](const Vec3<double>& m) {
    return (1 + 1e-5) * sampler.pdf(wi, m, {0.2, 0.05});
  };
  CHECK(over_normals(pdf, wi, {0.2, 0.05}) - 1 > kQuadratureError);
}

TEST_CASE("D of Beckmann is 0, not NaN, where its exponential has left the range") {
  const SmithSurface<float, BeckmannShape> surface;
  for (const float z : {1e-6f, 1e-12f, 1e-25f, 1e-40f})
    CHECK(surface.d({1, 0, z}, {0.5f, 0.5f}) == 0);
}
