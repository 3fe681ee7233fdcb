// Surfaces with correlated slopes and a mean slope: the maps from and to the flat surface, the
// closed form of Beckmann, the law of the normals, and BSDFs on them.
#include "vndf/rough_surface.h"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "support/bsdf_inputs.h"
#include "support/built_tables.h"
#include "support/catch.h"
#include "vndf/baking/bake.h"
#include "vndf/bsdf/conductor_brdf.h"
#include "vndf/bsdf/dielectric_bsdf.h"
#include "vndf/tabulated_sampler.h"

using namespace vndf;
using namespace vndf::test;

namespace {

/// Slopes by their covariance ((xx, xy), (xy, yy)), in units of alpha^2, and mean.
struct Covariance {
  double xx, xy, yy;
  Vec2<double> mean;
};
const std::vector<Covariance> kCovariances{{0.04, 0, 0.25, {0.5, -0.2}},
                                           {0.25, 0.125, 0.25, {0, 0}},
                                           {0.09, -0.0855, 0.09, {0.3, 0.4}},
                                           {1, 0.5, 0.3, {-2, 1}}};

RoughSurface<double> surface_of(const Covariance& c) {
  return RoughSurface<double>::from_covariance(c.xx, c.xy, c.yy, c.mean);
}

/// (x - mean)^T C^-1 (x - mean) for the slope x of `m`, by the inverse of the covariance.
double square_of(const Covariance& c, const Vec3<double>& m) {
  const double x = -m.x / m.z - c.mean.x, y = -m.y / m.z - c.mean.y;
  return (c.yy * x * x - 2 * c.xy * x * y + c.xx * y * y) / (c.xx * c.yy - c.xy * c.xy);
}

/// D of Beckmann slopes (Dupuy et al. 2013, equation 3, whose covariance is C / 2).
double beckmann_d(const Covariance& c, const Vec3<double>& m) {
  const double determinant = c.xx * c.yy - c.xy * c.xy;
  return std::exp(-square_of(c, m)) /
         (std::numbers::pi * std::sqrt(determinant) * m.z * m.z * m.z * m.z);
}

/// Lambda of Beckmann slopes along w (the same, equations 9 to 11): slopes in its azimuth are
/// Gaussian with their own mean and variance.
double beckmann_lambda(const Covariance& c, const Vec3<double>& w) {
  const double variance = c.xx * w.x * w.x + 2 * c.xy * w.x * w.y + c.yy * w.y * w.y;
  const double nu = (w.z - c.mean.x * w.x - c.mean.y * w.y) / std::sqrt(variance);
  return (std::exp(-nu * nu) / (nu * std::sqrt(std::numbers::pi)) - std::erfc(nu)) / 2;
}

Vec3<double> above_surface(RandomInputs& random, const RoughSurface<double>& surface) {
  for (;;) {
    const Vec3<double> w = random_direction(random, 89);
    if (surface.projected_area(w) > 0.02) return w;
  }
}

const TabulatedSampler<double>& beckmann() {
  static const TabulatedSampler<double> sampler(large_tables("beckmann").tables);
  return sampler;
}

bool close(double a, double b, double tolerance) {
  return std::abs(a - b) <= tolerance * std::abs(b);
}

}  // namespace

TEST_CASE("normals and directions of a surface keep their product, and the maps are inverse") {
  RandomInputs random(1);
  for (const Covariance& c : kCovariances)
    for (int i = 0; i < 100; ++i) {
      const RoughSurface<double> surface = surface_of(c);
      const Vec3<double> w = random_direction(random, 180), m = random_direction(random, 89);
      const Vec3<double> flat = surface.flattened_normal(m);
      CHECK(std::abs(dot(surface.flattened_direction(w), flat) - dot(w, m)) < 1e-14 * 16);
      const Vec3<double> back = surface.tilted_normal(flat);
      CHECK(std::hypot(back.x - m.x, back.y - m.y, back.z - m.z) < 1e-15 * 16);
    }
}

TEST_CASE("a surface is the same by covariance, by correlation, and turned") {
  RandomInputs random(2);
  const auto same = [&](const RoughSurface<double>& a, const RoughSurface<double>& b) {
    for (int i = 0; i < 20; ++i) {
      const Vec3<double> m = random_direction(random, 80);
      const OnSurface on_a(beckmann(), a), on_b(beckmann(), b);
      CHECK(close(on_a.d(m), on_b.d(m), 1e-9));
    }
  };
  for (const Covariance& c : kCovariances)
    same(surface_of(c), RoughSurface<double>::correlated({std::sqrt(c.xx), std::sqrt(c.yy)},
                                                         c.xy / std::sqrt(c.xx * c.yy), c.mean));
  const double angle = 0.4, cosine = std::cos(angle), sine = std::sin(angle), a = 0.25, b = 0.01;
  same(RoughSurface<double>::turned({0.5, 0.1}, angle, {0.1, 0}),
       RoughSurface<double>::from_covariance(a * cosine * cosine + b * sine * sine,
                                             (a - b) * sine * cosine,
                                             a * sine * sine + b * cosine * cosine, {0.1, 0}));
}

TEST_CASE("D, Lambda, G1 and the density of Beckmann slopes are the closed form to 1e-5") {
  RandomInputs random(3);
  for (const Covariance& c : kCovariances) {
    const OnSurface on(beckmann(), surface_of(c));
    for (int i = 0; i < 400; ++i) {
      const Vec3<double> wi = above_surface(random, on.surface());
      const Vec3<double> wm = on.sample(wi, random.uniform(), random.uniform());
      const double lambda = beckmann_lambda(c, wi), d = beckmann_d(c, wm);
      CAPTURE(i, wi.x, wi.y, wi.z, wm.x, wm.y, wm.z);
      CHECK(close(on.d(wm), d, 1e-5));
      CHECK(std::abs(on.lambda(wi) - lambda) <= 1e-5 * (1 + lambda));
      CHECK(close(on.g1(wi), 1 / (1 + lambda), 1e-5));
      const double area = on.surface().projected_area(wi) * (1 + lambda);
      CHECK(close(on.pdf(wi, wm), std::max(0.0, dot(wi, wm)) * d / area, 1e-5));
    }
  }
}

TEST_CASE(
    "normals of a surface are unit vectors that face the direction, drawn with their density") {
  // The mean of f over the samples is the integral of f times the density, for several f.
  constexpr int kSide = 500;
  RandomInputs random(4);
  for (const Covariance& c : kCovariances) {
    const OnSurface on(beckmann(), surface_of(c));
    const Vec3<double> wi = above_surface(random, on.surface());
    const auto f = [](const Vec3<double>& m) {
      return std::array{m.x, m.y, m.z * m.z, m.x * m.y, m.x > 0.2 * m.z ? 1.0 : 0.0};
    };
    std::array<double, 5> mean{}, integral{};
    for (int i = 0; i < kSide; ++i)
      for (int j = 0; j < kSide; ++j) {
        const Vec3<double> m = on.sample(wi, (i + 0.5) / kSide, (j + 0.5) / kSide);
        if (std::abs(dot(m, m) - 1) > 1e-14 || dot(wi, m) < -kFacingSlack<double> || m.z < 0)
          FAIL("no visible unit normal");
        for (std::size_t k = 0; k < mean.size(); ++k) mean[k] += f(m)[k] / kSide / kSide;
      }
    const int rings = 800;
    for (std::size_t k = 0; k < integral.size(); ++k)
      integral[k] =
          over_hemisphere([&](const Vec3<double>& m) { return f(m)[k] * on.pdf(wi, m); }, rings);
    CAPTURE(wi.x, wi.y, wi.z, c.xy, c.mean.x);
    // The midpoint rules err by some 1e-4 in the share, which is a step, and 1e-5 elsewhere.
    for (std::size_t k = 0; k < 4; ++k) CHECK(std::abs(mean[k] - integral[k]) < 1e-4);
    CHECK(std::abs(mean[4] - integral[4]) < 1e-3);
  }
}

TEST_CASE("visible facets show the area of the mean facet: the furnace of projected areas") {
  RandomInputs random(5);
  for (const Covariance& c : kCovariances) {
    const OnSurface on(beckmann(), surface_of(c));
    const Vec3<double> wi = above_surface(random, on.surface());
    const double area = over_hemisphere(
        [&](const Vec3<double>& m) { return std::max(0.0, dot(wi, m)) * on.d(m); }, 800);
    CHECK(close(on.g1(wi) * area, on.surface().projected_area(wi), 1e-4));
  }
}

TEST_CASE("a flat surface gives the sampler's own numbers, to the last bit") {
  RandomInputs random(6);
  for (int i = 0; i < 500; ++i) {
    const auto in = random.hard();
    const OnSurface on(beckmann(), RoughSurface<double>(in.alpha));
    const Vec3<double> wm = beckmann().sample(in.wi, in.alpha, in.u1, in.u2);
    const Vec3<double> same = on.sample(in.wi, in.u1, in.u2);
    CHECK((same.x == wm.x && same.y == wm.y && same.z == wm.z));
    CHECK(on.pdf(in.wi, wm) == beckmann().pdf(in.wi, wm, in.alpha));
    CHECK(on.d(wm) == beckmann().d(wm, in.alpha));
    CHECK(on.lambda(in.wi) == beckmann().lambda(in.wi, in.alpha));
    CHECK(on.g1(in.wi) == beckmann().g1(in.wi, in.alpha));
  }
}

TEST_CASE("a kernel draws on a surface what the shear makes of its normals, to rounding") {
  const KernelTables tables = bake(*small_tables("ggx").tables, {.tolerance = 1e-4});
  const Kernel kernel = tables.kernel();
  RandomInputs random(9);
  for (int i = 0; i < 2000; ++i) {
    const auto number = [&](double scale) { return static_cast<float>(scale * random.uniform()); };
    const Vec3<double> w = random_direction(random, 60);
    const Vec3<float> wi{static_cast<float>(w.x), static_cast<float>(w.y), static_cast<float>(w.z)};
    const auto surface = RoughSurface<float>::correlated(
        {0.1f + number(1), 0.1f + number(1)}, number(1.8) - 0.9f, {number(0.2), number(0.2)});
    const float u1 = number(1), u2 = number(1);
    const Vec3<float> drawn = OnSurface(kernel, surface).sample(wi, u1, u2);
    const Vec3<float> flat =
        kernel.sample(normalize_or_up(surface.flattened_direction(wi)), surface.alpha(), u1, u2);
    const Vec3<float> sheared = normalize_or_up(surface.tilted_normal(flat));
    CHECK(std::hypot(drawn.x - sheared.x, drawn.y - sheared.y, drawn.z - sheared.z) < 3e-6f);
    CHECK(std::abs(dot(drawn, drawn) - 1) <= 2 * kLengthSlack<float>);
  }
}

namespace {

/// Largest difference of one normal by two orders of the same steps: some roundings, which means
/// and shears of up to 2 multiply.
template <class T>
constexpr double kSurfaceRounding = 32 * std::numeric_limits<T>::epsilon();

/// Draws on `surface` with its density and goes back.
template <class Sampler>
void check_map_on(const Sampler& sampler, const RoughSurface<typename Sampler::Scalar>& surface,
                  double table_error) {
  using T = typename Sampler::Scalar;
  const OnSurface on(sampler, surface);
  RandomInputs random(10);
  for (int i = 0; i < 300; ++i) {
    const Vec3<double> w = random_direction(random, 180);
    const Vec3<T> wi{static_cast<T>(w.x), static_cast<T>(w.y), static_cast<T>(w.z)};
    // Far in the tail below the horizon a table in single precision knows the density less well.
    if (on.visible_area(wi) < T(1e-3)) continue;
    const T u1 = static_cast<T>(0.02 + 0.96 * random.uniform()),
            u2 = static_cast<T>(0.02 + 0.96 * random.uniform());
    const auto [wm, density] = on.sample_with_density(wi, u1, u2);
    const Vec3<T> same = on.sample(wi, u1, u2);
    CAPTURE(i, wi.x, wi.y, wi.z, u1, u2);
    CHECK(std::hypot(wm.x - same.x, wm.y - same.y, wm.z - same.z) < kSurfaceRounding<T>);
    CHECK(close(density, on.pdf(wi, wm), table_error));
    const auto back = on.invert(wi, wm);
    REQUIRE(back);
    CHECK(std::hypot(back->x - u1, back->y - u2) < 4 * kInverseError<T>);
  }
}

}  // namespace

TEST_CASE("a normal of a surface has the density there, and gives its random numbers back") {
  const KernelTables tables = bake(*large_tables("beckmann").tables, {.tolerance = 1e-5});
  for (const Covariance& c : kCovariances) {
    // The density of the map is a derivative of tables, which is known less well than u.
    check_map_on(beckmann(), surface_of(c), 1e-3);
    check_map_on(tables.kernel(),
                 RoughSurface<float>::from_covariance(
                     static_cast<float>(c.xx), static_cast<float>(c.xy), static_cast<float>(c.yy),
                     {static_cast<float>(c.mean.x), static_cast<float>(c.mean.y)}),
                 2e-2);
  }
}

TEST_CASE("a direction on a surface draws what its kernel draws there, to the last bit") {
  const KernelTables tables = bake(*small_tables("ggx").tables, {.tolerance = 1e-4});
  const Kernel kernel = tables.kernel();
  const auto surface = RoughSurface<float>::correlated({0.3f, 0.6f}, 0.5f, {0.7f, -0.4f});
  RandomInputs random(11);
  for (int i = 0; i < 500; ++i) {
    const Vec3<double> w = random_direction(random, 180);
    const Vec3<float> wi{static_cast<float>(w.x), static_cast<float>(w.y), static_cast<float>(w.z)};
    const float u1 = static_cast<float>(random.uniform()),
                u2 = static_cast<float>(random.uniform());
    const Vec3<float> a = OnSurface(kernel, surface).at(wi).sample(u1, u2);
    const Vec3<float> b = kernel.sample(wi, surface, u1, u2);
    CHECK((a.x == b.x && a.y == b.y && a.z == b.z));
  }
}

TEST_CASE("the visible area of a surface is that of its facets, on either side of it") {
  RandomInputs random(12);
  for (const Covariance& c : kCovariances) {
    const OnSurface on(beckmann(), surface_of(c));
    for (int i = 0; i < 10; ++i) {
      const Vec3<double> w = random_direction(random, 180);
      const double area = over_hemisphere(
          [&](const Vec3<double>& m) { return std::max(0.0, dot(w, m)) * on.d(m); }, 800);
      CHECK(std::abs(on.visible_area(w) - area) < 1e-4 * (1e-3 + area));
    }
  }
}

TEST_CASE("a metal on a surface is reciprocal, and reflects what its samples weigh") {
  RandomInputs random(7);
  for (const Covariance& c : kCovariances) {
    const RoughSurface<double> surface = surface_of(c);
    const ConductorBrdf metal(beckmann(), surface, PerfectMirror<double>{});
    for (int i = 0; i < 200; ++i) {
      const Vec3<double> wi = above_surface(random, surface), wo = above_surface(random, surface);
      const double there = metal.evaluate(wi, wo)[0] / surface.projected_area(wo);
      const double back = metal.evaluate(wo, wi)[0] / surface.projected_area(wi);
      CHECK(std::abs(there - back) <= 1e-9 * std::abs(there));
    }
    const Vec3<double> wi = above_surface(random, surface);
    constexpr int kSide = 400;
    double weights = 0;
    for (int i = 0; i < kSide; ++i)
      for (int j = 0; j < kSide; ++j) {
        const auto drawn = metal.sample(wi, (i + 0.5) / kSide, (j + 0.5) / kSide);
        if (drawn.weight[0] > 1) FAIL("a weight above 1");
        weights += drawn.weight[0] / kSide / kSide;
      }
    const auto sent = [&](const Vec3<double>& wo) {
      return metal.evaluate(wi, wo)[0] + metal.evaluate(wi, {wo.x, wo.y, -wo.z})[0];
    };
    CHECK(std::abs(over_hemisphere(sent, 800) - weights) < 2e-3);
  }
}

TEST_CASE("glass on a surface keeps its energy seen from either side") {
  RandomInputs random(8);
  const RoughSurface<double> surface = surface_of(kCovariances[0]);
  const DielectricBsdf glass(beckmann(), surface, 1.5);
  for (const double side : {1.0, -1.0}) {
    Vec3<double> wi = above_surface(random, surface);
    if (side < 0) wi = {-wi.x, -wi.y, -wi.z};
    constexpr int kSide = 150;
    double weights = 0;
    for (int i = 0; i < kSide; ++i)
      for (int j = 0; j < kSide; ++j)
        weights += glass.sample(wi, (i + 0.5) / kSide, (j + 0.5) / kSide, random.uniform()).weight /
                   kSide / kSide;
    const auto sent = [&](const Vec3<double>& wo) {
      return glass.evaluate(wi, wo) + glass.evaluate(wi, {wo.x, wo.y, -wo.z});
    };
    CHECK(weights <= 1);
    CHECK(std::abs(over_hemisphere(sent, 500) - weights) < 1e-2);
  }
}
