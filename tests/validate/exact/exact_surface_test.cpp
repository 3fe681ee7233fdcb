// The affine map of the exact side is compared with the covariance that it must have, and what the
// exact slopes make of it with sums over the plane of slopes and with the shear of the library.
#include "vndf/validate/exact/exact_surface.h"

#include <cmath>
#include <vector>

#include "support/catch.h"
#include "support/closed_forms.h"
#include "support/samplers_under_test.h"
#include "vndf/surface_slopes.h"
#include "vndf/validate/exact/normal_quadrature.h"
#include "vndf/validate/sampler/sampler_under_test.h"

using namespace vndf;
using namespace vndf::validate;
using namespace vndf::test;

namespace {

const std::vector<ExactSurface> kSurfaces{{{0.3, 0.9}, 0.5, {0.7, -0.4}},
                                          {{1, 1}, -0.95, {2, 1}},
                                          {{0.5, 0.5}, 0, {-1, 0.2}},
                                          {{0.02, 2}, 0.8, {0, 0}}};

const std::vector<Vec3<double>> kDirections{
    {0, 0, 1}, {0.6, 0, 0.8}, {-0.48, 0.6, 0.64}, {0.8, -0.6, 0}, {-0.6, 0.48, -0.64}};

/// The projected area of the facets of Beckmann slopes that face w, by a sum over slopes of unit
/// roughness, which were stretched by the triangular root of the covariance.
double summed_area(const ExactSurface& s, const Vec3<double>& w) {
  constexpr int kNodes = 1200;
  constexpr double kEnd = 6, kStep = 2 * kEnd / kNodes;
  const double along = std::sqrt(1 - s.correlation * s.correlation);
  double sum = 0;
  for (int i = 0; i < kNodes; ++i)
    for (int j = 0; j < kNodes; ++j) {
      const double p = -kEnd + (i + 0.5) * kStep, q = -kEnd + (j + 0.5) * kStep;
      const double x = s.mean.x + s.alpha.x * p;
      const double y = s.mean.y + s.alpha.y * (s.correlation * p + along * q);
      sum += std::max(0.0, w.z - w.x * x - w.y * y) * std::exp(-p * p - q * q);
    }
  return sum * kStep * kStep / 3.14159265358979324;
}

}  // namespace

TEST_CASE("the affine map of an exact surface is a symmetric root of the covariance") {
  for (const ExactSurface& s : kSurfaces) {
    // Slopes of the unit vectors: columns of M, with the mean slope taken off.
    const auto column = [&](double x, double y) {
      const Vec3<double> m = s.normal_of({x, y}, 1);
      return Vec2<double>{-m.x - s.mean.x, -m.y - s.mean.y};
    };
    const Vec2<double> a = column(1, 0), b = column(0, 1);
    CAPTURE(s.alpha.x, s.correlation);
    CHECK(a.y == Approx(b.x).margin(1e-15));
    CHECK(a.x * a.x + b.x * b.x == Approx(s.alpha.x * s.alpha.x));
    CHECK(a.y * a.y + b.y * b.y == Approx(s.alpha.y * s.alpha.y));
    CHECK(a.x * a.y + b.x * b.y == Approx(s.correlation * s.alpha.x * s.alpha.y).margin(1e-15));
    CHECK(s.determinant() == Approx(a.x * b.y - a.y * b.x));
    CHECK(std::hypot(s.along_x().x, s.along_x().y) == Approx(1));
  }
}

TEST_CASE("a normal of an exact surface and its slope of unit roughness give each other") {
  for (const ExactSurface& s : kSurfaces) {
    const Vec2<double> slope = s.unit_slope(s.normal_of({-1.5, 0.25}, 2));
    CHECK(slope.x == Approx(-1.5));
    CHECK(slope.y == Approx(0.25));
  }
}

TEST_CASE("the visible area of an exact surface is a sum over its slopes, from below too") {
  const auto slopes = exact_slopes("beckmann");
  for (const ExactSurface& s : kSurfaces)
    for (const Vec3<double>& w : kDirections) {
      CAPTURE(s.correlation, s.mean.x, w.x, w.z);
      // The kink of the summand along a line leaves an error of the square of the step.
      CHECK(slopes->visible_area(w, s) == Approx(summed_area(s, w)).epsilon(1e-3).margin(1e-5));
    }
}

TEST_CASE("Lambda and G1 are relative to the mean facet, as in LEADR") {
  const auto slopes = exact_slopes("ggx");
  for (const ExactSurface& s : kSurfaces)
    for (const Vec3<double>& w : kDirections) {
      const double height = std::abs(s.height(w));
      CAPTURE(s.correlation, s.mean.x, w.x, w.z);
      if (height == 0) continue;
      const double area = slopes->visible_area(w, s);
      const double above = s.height(w) > 0 ? height : 0;
      CHECK(height * slopes->lambda(w, s) == Approx(area - above).margin(1e-12));
      CHECK(slopes->g1(w, s) == Approx(1 / (1 + slopes->lambda(w, s))));
    }
}

TEST_CASE("D, the visible area and the density are those of a closed form after the shear") {
  const auto slopes = exact_slopes("ggx");
  const ClosedFunctions<double, GgxForms> ggx;
  for (const ExactSurface& s : kSurfaces)
    for (const Vec3<double>& w : kDirections) {
      const OnSurface on(ggx, rough_surface<double>(s));
      const Configuration c{w, s.alpha, s.correlation, s.mean};
      if (c.height() <= 0) continue;
      const ExactDistribution law(*slopes, SampledNormals::visible_smith, c, Use::few);
      for (const Vec2<double>& unit : {Vec2<double>{0, 0}, {-0.7, 0.2}, {-2, -3}, {0.1, 9}}) {
        const Vec3<double> wm = normalize_or_up(s.normal_of(unit, 1));
        CAPTURE(s.correlation, s.mean.x, w.x, w.z, unit.x, unit.y);
        CHECK(slopes->d(wm, s) == Approx(on.d(wm)).epsilon(1e-9));
        CHECK(law.pdf(wm) == Approx(on.pdf(w, wm)).epsilon(1e-9).margin(1e-15));
      }
      CHECK(slopes->lambda(w, s) == Approx(on.lambda(w)).epsilon(1e-9));
    }
}

TEST_CASE("uniform numbers on a surface have the moments of uniform numbers") {
  const auto slopes = exact_slopes("exponential-power:p=0.5");
  for (const ExactSurface& s : kSurfaces)
    for (const Vec3<double>& w : kDirections) {
      const Configuration c{w, s.alpha, s.correlation, s.mean};
      const ExactDistribution law(*slopes, SampledNormals::visible_smith, c);
      const auto nodes = normal_quadrature(*slopes, SampledNormals::visible_smith, c);
      double mass = 0, r = 0, phi = 0, both = 0, x = 0;
      for (std::size_t k = 0; k < nodes.wm.size(); ++k) {
        const double p = law.pdf(nodes.wm[k]) * nodes.weight[k];
        const Uniforms u = law.uniforms(nodes.wm[k], 0.5);
        mass += p;
        r += p * u.r;
        phi += p * u.phi;
        both += p * u.r * u.phi;
        x += p * u.x;
      }
      CAPTURE(s.correlation, s.mean.x, w.x, w.z);
      CHECK(mass == Approx(nodes.covered).margin(kQuadratureError));
      CHECK(r == Approx(1.0 / 2).margin(1e-5));
      CHECK(phi == Approx(1.0 / 2).margin(1e-5));
      CHECK(both == Approx(1.0 / 4).margin(1e-5));
      // Slope x is smooth along no axis of the nodes.
      CHECK(x == Approx(1.0 / 2).margin(1e-4));
    }
}
