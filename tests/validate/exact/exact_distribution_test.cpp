// The transform of normals to uniform numbers is compared with the density of normals, which it
// must belong to, and is tested at its ends.
#include "vndf/validate/exact/exact_distribution.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "support/catch.h"
#include "support/samplers_under_test.h"
#include "vndf/validate/exact/normal_quadrature.h"

using namespace vndf;
using namespace vndf::validate;
using namespace vndf::test;

namespace {

constexpr SampledNormals kKinds[]{SampledNormals::visible_smith, SampledNormals::visible_v_cavity,
                                  SampledNormals::all};
const Configuration kTilted = at_angles(60, 35, 0.7, 0.3);

double weighted(const ExactDistribution& exact, const NormalQuadrature& nodes,
                double (*f)(const Uniforms&)) {
  double sum = 0;
  for (std::size_t k = 0; k < nodes.wm.size(); ++k)
    sum += exact.pdf(nodes.wm[k]) * nodes.weight[k] * f(exact.uniforms(nodes.wm[k], 0.5));
  return sum;
}

}  // namespace

TEST_CASE("uniform numbers have the moments of uniform numbers under the density of normals") {
  // Quadrature of the pdf over the hemisphere: a reference that knows no CDF.
  for (const std::string name : {"ggx", "disk", "mixture:0.7*ggx+0.3*beckmann@0.2"}) {
    const auto slopes = exact_slopes(name);
    for (const SampledNormals kind : kKinds)
      for (const Configuration& c : {kTilted, at_angles(85, 100, 0.1, 1)}) {
        const ExactDistribution exact(*slopes, kind, c);
        const auto nodes = normal_quadrature(*slopes, kind, c);
        const auto moment = [&](double (*f)(const Uniforms&)) { return weighted(exact, nodes, f); };
        CAPTURE(name, static_cast<int>(kind), c.theta());
        CHECK(moment([](const Uniforms&) { return 1.0; }) ==
              Approx(nodes.covered).margin(kQuadratureError));
        CHECK(moment([](const Uniforms& w) { return w.r; }) == Approx(1.0 / 2).margin(1e-5));
        CHECK(moment([](const Uniforms& w) { return w.phi; }) == Approx(1.0 / 2).margin(1e-5));
        CHECK(moment([](const Uniforms& w) { return w.r * w.r; }) == Approx(1.0 / 3).margin(1e-5));
        CHECK(moment([](const Uniforms& w) { return w.phi * w.phi; }) ==
              Approx(1.0 / 3).margin(1e-5));
        CHECK(moment([](const Uniforms& w) { return w.r * w.phi; }) ==
              Approx(1.0 / 4).margin(1e-5));
      }
  }
}

TEST_CASE("the derivative of w_x is the marginal density, weighted by what is seen") {
  const auto slopes = exact_slopes("beckmann");
  for (const SampledNormals kind : kKinds) {
    const ExactDistribution exact(*slopes, kind, kTilted);
    const double c = exact.frame().cotangent().slope();
    const double hidden = slopes->unit_slopes().backfacing(c).value;
    for (double x = -2.9; x < 3; x += 0.19) {
      const auto w = [&](double at) {
        return exact.uniforms(exact.frame().normal_of({at, 0.3, 1}), 0.5).x;
      };
      const double seen = std::max(0.0, c - x);
      const double weight = kind == SampledNormals::all             ? 1
                            : kind == SampledNormals::visible_smith ? seen / (c + hidden)
                                                                    : std::min(seen, 2 * c) / c;
      const double p = slopes->unit_slopes().density(std::abs(x)).value;
      CAPTURE(static_cast<int>(kind), x);
      CHECK((w(x + 1e-5) - w(x - 1e-5)) / 2e-5 == Approx(p * weight).epsilon(1e-4).margin(1e-8));
    }
  }
}

TEST_CASE("the distribution at the horizon is the limit of those just above it") {
  const auto slopes = exact_slopes("beckmann");
  const Configuration at = at_angles(90, 0, 0.5, 0.5), above{{1, 0, 1e-12}, at.alpha};
  for (const SampledNormals kind : kKinds) {
    const ExactDistribution limit(*slopes, kind, at), near(*slopes, kind, above);
    for (const double x : {-0.01, -0.7, -2.0})
      for (const double y : {-1.5, -0.2, 0.0, 0.4, 3.0}) {
        const Vec3<double> wm = limit.frame().normal_of({x, y, 1});
        const Uniforms a = limit.uniforms(wm, 0.5), b = near.uniforms(wm, 0.5);
        CAPTURE(static_cast<int>(kind), x, y);
        CHECK(a.r == Approx(b.r).margin(1e-8));
        CHECK(a.phi == Approx(b.phi).margin(1e-8));
        CHECK(a.x == Approx(b.x).margin(1e-8));
        CHECK(limit.pdf(wm) == Approx(near.pdf(wm)).epsilon(1e-8));
      }
  }
}

TEST_CASE("Lambda, G1 and D agree with the closed forms of GGX") {
  const auto slopes = exact_slopes("ggx");
  const ClosedFunctions<double, GgxForms> closed;
  for (const double degrees : {1.0, 30.0, 75.0, 89.9}) {
    const Configuration c = at_angles(degrees, 20, 0.5, 0.2);
    CHECK(slopes->lambda(c.wi, c.alpha) == Approx(closed.lambda(c.wi, c.alpha)).epsilon(1e-10));
    CHECK(slopes->g1(c.wi, c.alpha) == Approx(closed.g1(c.wi, c.alpha)).epsilon(1e-10));
    CHECK(slopes->d(c.wi, c.alpha) == Approx(closed.d(c.wi, c.alpha)).epsilon(1e-10));
  }
  CHECK(slopes->g1({1, 0, 0}, Alpha<double>{0.5, 0.5}) == 0);
  CHECK(slopes->d({1, 0, 0}, Alpha<double>{0.5, 0.5}) == 0);
}

TEST_CASE("the stretched frame turns a slope into a normal and back") {
  const auto slopes = exact_slopes("beckmann");
  const StretchedFrame frame(*slopes, kTilted);
  const StretchedSlope s = frame.slope_of(frame.normal_of({-1.5, 0.25, 1}));
  CHECK(s.x / s.w == Approx(-1.5));
  CHECK(s.y / s.w == Approx(0.25));
}

TEST_CASE("a normal beyond single precision is placed at random in the mass beyond its edge") {
  const auto slopes = exact_slopes("student-t:gamma=1.55");
  const ExactDistribution exact(*slopes, SampledNormals::visible_smith, kTilted);
  const Vec3<double> edge{-0.8, -0.6, kSmallestHeight}, horizontal{-0.8, -0.6, 0};
  const Uniforms at_edge = exact.uniforms(edge, 0.3);
  CHECK(1 - at_edge.r > 1e-6);  // there is a mass to speak of
  CHECK(exact.uniforms(horizontal, 1).r == Approx(at_edge.r).epsilon(1e-12));
  CHECK(exact.uniforms(horizontal, 0).r == 1);
  CHECK(exact.uniforms(horizontal, 0.5).r == Approx((1 + at_edge.r) / 2));
  CHECK(exact.uniforms(horizontal, 0.5).phi == Approx(at_edge.phi).epsilon(1e-6));
}

TEST_CASE("the pole, the horizon and the edge of visibility are ends of the uniform square") {
  const auto slopes = exact_slopes("ggx");
  const ExactDistribution exact(*slopes, SampledNormals::visible_smith, at_angles(60, 0, 1, 1));
  CHECK(exact.uniforms({0, 0, 1}, 0.5).r == 0);
  CHECK(exact.uniforms({1, 0, 0}, 0.5).r == Approx(1));
  // Normals at right angles to wi have slope x = cot(theta), the largest that is seen.
  const double c = std::cos(60 * kDegree), s = std::sin(60 * kDegree);
  CHECK(exact.uniforms({-c, 0, s}, 0.5).x == Approx(1));
  CHECK(exact.uniforms({-c, 1e-6, s}, 0.5).phi == Approx(0.5).margin(1e-4));
}
