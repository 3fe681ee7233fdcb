// Directions below the horizon, for the pair and for the kernel: the distribution of the normals
// against the exact one in polar slopes, which knows neither tables nor their builder's CDF; the
// areas and densities against quadrature; and what is returned where nothing or only infinite
// slopes are visible.
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "support/baked_tables.h"
#include "support/catch.h"
#include "support/directions.h"
#include "support/samplers_under_test.h"
#include "support/tolerances.h"
#include "vndf/tabulated_sampler.h"
#include "vndf/validate/exact/normal_quadrature.h"
#include "vndf/validate/statistics/uniformity.h"

using namespace vndf;
using namespace vndf::test;
using namespace vndf::validate;

namespace {

const std::vector<std::string> kFamilies{"ggx",    "beckmann",       "student-t:gamma=1.6",
                                         "disk",   "pearson-ii:m=3", "exponential-power:p=0.5",
                                         "k:nu=1", kMixture};

/// From just below the horizon to where some 1e-9 of the surface is visible of a light tail.
const std::vector<Configuration> kConfigurations{
    at_angles(90.01, 20, 0.5, 0.5), at_angles(100, 45, 2, 1), at_angles(130, 100, 0.3, 0.9),
    at_angles(170, 200, 0.8, 0.8), at_angles(150, 300, 1, 0.01)};

Vec3<float> narrow(const Vec3<double>& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
Alpha<float> narrow(const Alpha<double>& a) {
  return {static_cast<float>(a.x), static_cast<float>(a.y)};
}

/// Enough is visible for a distribution.
bool sees(const ExactSlopes& exact, const Configuration& c) {
  return exact.visible_area(c.wi, c.alpha) > 1e-9;
}

/// The p-value of normals drawn from wi as those seen from `claimed`.
template <class Sampler>
double p_value(const Sampler& sampler, const ExactSlopes& exact, const Configuration& c,
               const Configuration& claimed, const DeclaredErrors& declared) {
  constexpr int kSamples = 100000;
  constexpr std::size_t kLine = 211;
  const ExactDistribution law(exact, SampledNormals::visible_smith, claimed);
  std::mt19937_64 random(17);
  const auto uniform = [&] { return std::ldexp(static_cast<float>(random() >> 40), -24); };
  LineCounts r(kLine), phi(kLine), x(kLine);
  for (int k = 0; k < kSamples; ++k) {
    const float u1 = uniform(), u2 = uniform();
    const Vec3<float> wm = sampler.sample(narrow(c.wi), narrow(c.alpha), u1, u2);
    const Uniforms w = law.uniforms({wm.x, wm.y, wm.z}, 0.5);
    r.add(w.r);
    phi.add(w.phi);
    x.add(w.x);
  }
  double p = 1;
  for (const LineCounts* counts : {&r, &phi, &x})
    p = std::min({p, counts->chi_square(declared), counts->cumulative(declared)});
  return p;
}

/// What a small pair of every family keeps.
constexpr double kTolerance = 5e-4;

struct Both {
  explicit Both(const std::string& distribution)
      : pair(small_tables(distribution).tables),
        baked(bake(pair.tables(), {.tolerance = kTolerance})),
        kernel(baked.kernel()) {}
  TabulatedSampler<float> pair;
  KernelTables baked;
  Kernel kernel;
};

}  // namespace

TEST_CASE("normals seen from below are distributed as the polar law says, of every family") {
  for (const std::string& family : kFamilies) {
    const auto exact = exact_slopes(family);
    const Both both(family);
    const Certificate& pair = small_tables(family).certificate;
    for (const Configuration& c : kConfigurations) {
      if (!sees(*exact, c)) continue;
      const DeclaredErrors declared{
          pair.below.max_u_error + pair.conditional.max_u_error + kTolerance, 0.1, 0.1};
      CAPTURE(family, c.theta(), c.alpha.x, c.alpha.y);
      CHECK(p_value(both.pair, *exact, c, c, declared) > kSignificance);
      CHECK(p_value(both.kernel, *exact, c, c, declared) > kSignificance);
    }
  }
}

TEST_CASE("normals seen from a tenth of a radian away are told apart") {
  const auto exact = exact_slopes("ggx");
  const Configuration c = at_angles(120, 30, 0.7, 0.7), other = at_angles(126, 30, 0.7, 0.7);
  CHECK(p_value(Both("ggx").kernel, *exact, c, other, {1e-4, 0.02, 0.1}) < kSignificance);
}

TEST_CASE("the visible area is that of a sum over radii, to a part of 1e-12 of the surface") {
  for (const std::string& family : kFamilies) {
    const auto exact = exact_slopes(family);
    const Both both(family);
    const double mu = exact->unit_slopes().mean_slope();
    for (const double degrees : {90.0, 91.0, 110.0, 140.0, 160.0, 168.0, 175.0}) {
      const Configuration c = at_angles(degrees, 0, 1, 1);
      const double length = std::hypot(c.wi.x * mu, c.wi.z);
      const RadialDistribution radii(exact->unit_slopes(), bounded_cotangent(c.wi.z, mu * c.wi.x));
      const double area = length * radii.visible_area();
      if (!(area > kLeastArea)) continue;
      CAPTURE(family, degrees, area);
      CHECK(exact->visible_area(c.wi, c.alpha) == Approx(area).epsilon(1e-6));
      CHECK(both.pair.visible_area(narrow(c.wi), {1, 1}) == Approx(area).epsilon(1e-4));
      CHECK(both.kernel.visible_area(narrow(c.wi), {1, 1}) == Approx(area).epsilon(2e-4));
    }
  }
}

TEST_CASE("densities of directions below the horizon integrate to 1") {
  for (const std::string& family :
       {std::string("ggx"), std::string("beckmann"), std::string("disk")}) {
    const auto exact = exact_slopes(family);
    const Both both(family);
    for (const Configuration& c : kConfigurations) {
      if (!sees(*exact, c)) continue;
      const auto nodes = normal_quadrature(*exact, SampledNormals::visible_smith, c);
      double of_exact = 0, of_kernel = 0;
      const ExactDistribution law(*exact, SampledNormals::visible_smith, c, Use::few);
      for (std::size_t k = 0; k < nodes.wm.size(); ++k) {
        of_exact += nodes.weight[k] * law.pdf(nodes.wm[k]);
        of_kernel +=
            nodes.weight[k] * both.kernel.pdf(narrow(c.wi), narrow(nodes.wm[k]), narrow(c.alpha));
      }
      CAPTURE(family, c.theta(), c.alpha.x);
      CHECK(of_exact == Approx(nodes.covered).margin(kQuadratureError));
      CHECK(of_kernel == Approx(nodes.covered).epsilon(1e-3));
    }
  }
}

TEST_CASE("the density of the map from below is close to that of the distribution") {
  const auto density_ratio = [](const auto& sampler, const Vec3<float>& wi, float u1, float u2) {
    const auto drawn = sampler.sample_with_density(wi, {0.7f, 0.4f}, u1, u2);
    return drawn.pdf / sampler.pdf(wi, drawn.wm, {0.7f, 0.4f});
  };
  for (const std::string& family :
       {std::string("ggx"), std::string("beckmann"), std::string(kMixture)}) {
    const Both both(family);
    for (const double degrees : {90.5, 105.0, 130.0})
      for (const float u1 : {0.05f, 0.3f, 0.62f, 0.9f})
        for (const float u2 : {0.1f, 0.45f, 0.8f}) {
          const auto wi = direction_at<float>(degrees, 70);
          CAPTURE(family, degrees, u1, u2);
          CHECK(density_ratio(both.pair, wi, u1, u2) == Approx(1).margin(0.05));
          CHECK(density_ratio(both.kernel, wi, u1, u2) == Approx(1).margin(0.15));
        }
  }
}

TEST_CASE("invert gives the random numbers of a normal seen from below") {
  for (const std::string& family : kFamilies) {
    const TabulatedSampler<double> pair(small_tables(family).tables);
    const Both both(family);
    for (const double degrees : {90.5, 100.0, 109.0})
      for (const double u1 : {0.11, 0.4, 0.77})
        for (const double u2 : {0.2, 0.6}) {
          const Configuration c = at_angles(degrees, 70, 0.7, 0.4);
          const auto u = pair.invert(c.wi, pair.sample(c.wi, c.alpha, u1, u2), c.alpha);
          CAPTURE(family, degrees, u1, u2);
          REQUIRE(u);
          CHECK(u->x == Approx(u1).margin(1e-10));
          CHECK(u->y == Approx(u2).margin(1e-10));
          const auto wi = narrow(c.wi);
          const auto a = narrow(c.alpha);
          const auto v = both.kernel.invert(
              wi, both.kernel.sample(wi, a, static_cast<float>(u1), static_cast<float>(u2)), a);
          REQUIRE(v);
          CHECK(v->x == Approx(u1).margin(1e-3));
          CHECK(v->y == Approx(u2).margin(1e-3));
        }
  }
}

TEST_CASE("straight from below the normals are horizontal, those of the limit") {
  const float below = -1;
  for (const std::string& family :
       {std::string("ggx"), std::string("beckmann"), std::string(kMixture)}) {
    const Both both(family);
    const auto check = [&](const auto& sampler) {
      for (const float u2 : {0.1f, 0.5f, 0.7f}) {
        const Vec3<float> limit = sampler.sample({1e-6f, 0, below}, {1, 1}, 0.5f, u2);
        const Vec3<float> wm = sampler.sample({0, 0, below}, {1, 1}, 0.5f, u2);
        CAPTURE(family, u2, wm.x, wm.y, wm.z);
        CHECK(finite_unit(wm));
        CHECK(wm.z < 1e-15f);
        CHECK(std::abs(wm.x - limit.x) + std::abs(wm.y - limit.y) < 1e-3f);
      }
      CHECK(sampler.visible_area({0, 0, below}, {1, 1}) == 0);
      CHECK(sampler.pdf({0, 0, below}, {0.6f, 0, 0.8f}, {1, 1}) == 0);
    };
    check(both.pair);
    check(both.kernel);
  }
}

TEST_CASE("of bounded slopes nothing is visible from below their rim") {
  for (const std::string& family : {std::string("disk"), std::string("annulus:inner=0.5")}) {
    const TabulatedSampler<float> pair(small_tables(family).tables);
    const KernelTables tables = bake(pair.tables(), {.tolerance = 1e-2});
    const Kernel kernel = tables.kernel();
    const auto check = [&](const auto& sampler) {
      // The rim is at slope 1, and a slope x = -1 faces wi where wi.x > -wi.z.
      for (const Vec3<float>& wi : {Vec3<float>{0.6f, 0, -0.8f}, {0, 0, -1}}) {
        CAPTURE(family, wi.x);
        CHECK(same(sampler.sample(wi, {1, 1}, 0.3f, 0.6f), {0, 0, 1}));
        CHECK(sampler.sample_with_density(wi, {1, 1}, 0.3f, 0.6f).pdf == 0);
        CHECK(sampler.pdf(wi, {0.7f, 0, 0.714f}, {1, 1}) == 0);
        CHECK_FALSE(sampler.invert(wi, {0.7f, 0, 0.714f}, {1, 1}));
      }
      const Vec3<float> wi{0.8f, 0, -0.6f}, wm = sampler.sample(wi, {1, 1}, 0.3f, 0.6f);
      CHECK(dot(wi, wm) > 0);
    };
    check(pair);
    check(kernel);
  }
}

TEST_CASE("tables without rows for directions below the horizon return the fallback there") {
  const SlopeTables& pair = *small_tables("ggx").tables;
  const KernelTables above = bake(pair, {.tolerance = kBakedWithin, .below_horizon = false});
  const KernelTables both = baked_tables("ggx");
  CHECK(above.header().below_bytes == 0);
  CHECK(above.bytes().size() < both.bytes().size());
  CHECK(above.sampling_bytes() == both.sampling_bytes());
  const Vec3<float> below{0.6f, 0, -0.8f}, wi{0.6f, 0, 0.8f};
  const Kernel kernel = above.kernel();
  CHECK(same(kernel.sample(below, {1, 1}, 0.3f, 0.6f), {0, 0, 1}));
  CHECK(kernel.sample_with_density(below, {1, 1}, 0.3f, 0.6f).pdf == 0);
  CHECK(same(kernel.sample(wi, {1, 1}, 0.3f, 0.6f), both.kernel().sample(wi, {1, 1}, 0.3f, 0.6f)));
  SlopeTables cut = pair;
  cut.marginal_rows = {};
  const TabulatedSampler<float> sampler(share(cut));
  CHECK(same(sampler.sample(below, {1, 1}, 0.3f, 0.6f), {0, 0, 1}));
  CHECK(bake(cut, {.tolerance = 1e-2}).header().below_bytes == 0);
}
