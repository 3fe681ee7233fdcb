// BRDF and BSDF over any sampler: the same function evaluated, integrated and sampled.
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

#include "support/bsdf_inputs.h"
#include "support/built_tables.h"
#include "support/catch.h"
#include "vndf/bsdf/conductor_brdf.h"
#include "vndf/bsdf/dielectric_bsdf.h"
#include "vndf/tabulated_sampler.h"

using namespace vndf;
using namespace vndf::test;

namespace {

using Ggx = ExactGgx<double>;
using AllGgx = AllNormals<Ggx>;
template <class Sampler, class Masking>
using Mirror = ConductorBrdf<Sampler, PerfectMirror<double>, Masking>;

/// evaluate(), pdf() and sample() are the same few products: relative rounding where the half
/// vector is well conditioned, alpha >= 0.05.
constexpr double kAgreement = 1e-9;

const ConductorFresnel kGold{{0.14, 0.37, 1.44}, {4.1, 2.3, 1.8}};
const Ggx kGgx;
const AllGgx kAllGgx{kGgx};
const ExactVCavity kVCavity{kAllGgx};

struct Configuration {
  double degrees, azimuth;
  Alpha<double> alpha;
};
const std::vector<Configuration> kConfigurations{
    {0, 0, {0.5, 0.5}}, {30, 40, {0.3, 0.6}}, {60, 0, {1, 1}}, {80, 70, {0.5, 0.3}}};

/// Calls f(name, sampler, masking) for every pair of a sampler and a model that belong together.
template <class F>
void for_each_surface(F f) {
  f("visible, separable", kGgx, SmithSeparable{});
  f("visible, correlated", kGgx, SmithCorrelated{});
  f("visible, V-cavities", kVCavity, VCavityMasking{});
  f("all, separable", kAllGgx, SmithSeparable{});
  f("all, correlated", kAllGgx, SmithCorrelated{});
  f("all, V-cavities", kAllGgx, VCavityMasking{});
}

Vec3<double> mirrored(const Vec3<double>& w) {
  return {w.x, w.y, -w.z};
}

struct Mean {
  double value, error;
};

/// Mean of f(u1, u2, u3) over `count` random numbers and its standard error.
template <class F>
Mean mean_of(F f, int count, std::uint64_t seed) {
  RandomInputs random(seed);
  // 53 random bits: the V-cavity sampler spends the lower ones.
  const auto u = [&] { return random.uniform() + std::ldexp(random.uniform(), -24); };
  double sum = 0, squares = 0;
  for (int i = 0; i < count; ++i) {
    const double u1 = u(), u2 = u(), value = f(u1, u2, u());
    sum += value;
    squares += value * value;
  }
  const double mean = sum / count;
  return {mean, std::sqrt((squares / count - mean * mean) / count)};
}

template <class F>
double over_sphere(F f, int rings = 600) {
  return over_hemisphere([&](const auto& w) { return f(w) + f(mirrored(w)); }, rings);
}

template <class T, class Value>
bool sound(const Value& values) {
  for (const T v : values)
    if (!(v >= 0 && std::isfinite(v))) return false;
  return true;
}

/// Every function gives a finite non-negative number and visible normals weights of at most 1.
template <class T, class Sampler, class Masking>
void check_hard_cases(const Sampler& sampler, std::uint64_t seed, bool visible) {
  RandomInputs random(seed);
  for (int i = 0; i < 1000; ++i) {
    const auto in = random.hard();
    auto alpha = in.alpha;
    if (i % 10 == 0) alpha.y = alpha.x / 1000;
    const Alpha<T> a{static_cast<T>(alpha.x), static_cast<T>(alpha.y)};
    Vec3<T> wi{static_cast<T>(in.wi.x), static_cast<T>(in.wi.y), static_cast<T>(in.wi.z)};
    if (i % 7 == 0) wi = {T(0.6), T(0.8), T(0)};
    const T u1 = static_cast<T>(in.u1), u2 = static_cast<T>(in.u2);
    const T u3 = static_cast<T>(random.uniform());
    CAPTURE(i, wi.x, wi.y, wi.z, a.x, a.y, u1, u2, u3, sizeof(T));

    const ConductorBrdf brdf(sampler, a, PerfectMirror<T>{}, Masking{});
    const auto drawn = brdf.sample(wi, u1, u2);
    REQUIRE(sound<T>(std::array{drawn.weight[0], drawn.pdf, brdf.pdf(wi, drawn.wo),
                                brdf.evaluate(wi, drawn.wo)[0]}));
    if (visible) REQUIRE(drawn.weight[0] <= 1);

    for (const T eta : {T(0.25), T(1) / T(1.5), T(1), std::nextafter(T(1), T(2)), T(1.5), T(4)}) {
      const DielectricBsdf bsdf(sampler, a, eta, Masking{});
      for (const Vec3<T>& w : {wi, Vec3<T>{wi.x, wi.y, -wi.z}}) {
        const auto sent = bsdf.sample(w, u1, u2, u3);
        CAPTURE(eta, sent.wo.x, sent.wo.y, sent.wo.z);
        REQUIRE(sound<T>(
            std::array{sent.weight, sent.pdf, bsdf.pdf(w, sent.wo), bsdf.evaluate(w, sent.wo)}));
        if (visible) REQUIRE(sent.weight <= 1);
      }
    }
  }
}

template <class T>
void check_hard_cases_of(const char* distribution) {
  const TabulatedSampler<T> tabulated(small_tables(distribution).tables);
  const AllNormals<TabulatedSampler<T>> all(tabulated);
  CAPTURE(distribution);
  check_hard_cases<T, TabulatedSampler<T>, SmithSeparable>(tabulated, 1, true);
  check_hard_cases<T, TabulatedSampler<T>, SmithCorrelated>(tabulated, 2, true);
  check_hard_cases<T, AllNormals<TabulatedSampler<T>>, SmithCorrelated>(all, 3, false);
  check_hard_cases<T, AllNormals<TabulatedSampler<T>>, VCavityMasking>(all, 4, false);
}

// The types follow from the arguments, and no BSDF may refer to a sampler that is gone.
template <class... A>
concept Conductor = requires(A&&... a) {
  ConductorBrdf(std::forward<A>(a)...);
};
template <class... A>
concept Dielectric = requires(A&&... a) {
  DielectricBsdf(std::forward<A>(a)...);
};
using Gold = ConductorFresnel<double, 3>;
static_assert(std::is_same_v<decltype(kGold), const Gold>);
static_assert(std::is_same_v<decltype(ConductorBrdf(kGgx, {0.3, 0.1}, kGold)),
                             ConductorBrdf<Ggx, Gold, SmithCorrelated>>);
static_assert(std::is_same_v<decltype(ConductorBrdf(kVCavity, {0.3, 0.1}, kGold, VCavityMasking{})),
                             ConductorBrdf<ExactVCavity, Gold, VCavityMasking>>);
static_assert(std::is_same_v<decltype(DielectricBsdf(kGgx, {0.3, 0.1}, 1.5)),
                             DielectricBsdf<Ggx, SmithCorrelated>>);
static_assert(Conductor<Ggx&, Alpha<double>, Gold> && !Conductor<Ggx, Alpha<double>, Gold>);
static_assert(Dielectric<Ggx&, Alpha<double>, double> && !Dielectric<Ggx, Alpha<double>, double>);

}  // namespace

TEST_CASE("the BRDF is the same read backwards") {
  RandomInputs random(1);
  for_each_surface([&](const char* name, const auto& sampler, auto masking) {
    for (int i = 0; i < 500; ++i) {
      const auto wi = random_direction(random, 89), wo = random_direction(random, 89);
      const Alpha<double> alpha{0.05 + random.uniform(), 0.05 + random.uniform()};
      const ConductorBrdf brdf(sampler, alpha, kGold, masking);
      const auto there = brdf.evaluate(wi, wo), back = brdf.evaluate(wo, wi);
      CAPTURE(name, i);
      for (std::size_t c = 0; c < 3; ++c)
        REQUIRE(there[c] / wo.z == Approx(back[c] / wi.z).epsilon(kAgreement));
    }
  });
}

TEST_CASE("the BSDF of a dielectric is the same read backwards, but for the squared indices") {
  RandomInputs random(2);
  int transmitted = 0;
  for_each_surface([&](const char* name, const auto& sampler, auto masking) {
    for (const double eta : {0.66, 1.33, 2.4})
      for (int i = 0; i < 500; ++i) {
        const auto wi = random_direction(random, 180), wo = random_direction(random, 180);
        const Alpha<double> alpha{0.05 + random.uniform(), 0.05 + random.uniform()};
        const DielectricBsdf bsdf(sampler, alpha, eta, masking);
        const auto index_squared = [&](const auto& w) { return w.z > 0 ? 1 : eta * eta; };
        const double there = bsdf.evaluate(wi, wo) / std::abs(wo.z) / index_squared(wo);
        const double back = bsdf.evaluate(wo, wi) / std::abs(wi.z) / index_squared(wi);
        CAPTURE(name, eta, i, wi.z, wo.z);
        REQUIRE(there == Approx(back).epsilon(kAgreement).margin(1e-14));
        if (there > 0 && wi.z * wo.z < 0) ++transmitted;
      }
  });
  CHECK(transmitted > 500);
}

TEST_CASE("the visible normals have mass 1, also as outgoing directions (weak white furnace)") {
  for (const auto& c : kConfigurations) {
    const auto wi = direction_at<double>(c.degrees, c.azimuth);
    const Microsurface<Ggx, SmithSeparable> smith(kGgx, c.alpha);
    const Microsurface<ExactVCavity, VCavityMasking> cavities(kVCavity, c.alpha);
    CAPTURE(c.degrees, c.alpha.x, c.alpha.y);
    CHECK(over_hemisphere([&](const auto& m) { return smith.visible_density(wi, m); }) ==
          Approx(1).margin(1e-4));
    CHECK(over_hemisphere([&](const auto& m) { return cavities.visible_density(wi, m); }) ==
          Approx(1).margin(3e-4));  // a kink where G1 reaches 1
    CHECK(over_hemisphere([&](const auto& m) { return cavities.pdf(wi, m); }) ==
          Approx(1).margin(3e-4));
    // int G1(wi) D(wm) / (4 wi.z) dwo = 1 over the whole sphere of wo.
    const auto reflected = [&](const Vec3<double>& wo) {
      const auto m = reflection_half_vector(wi, wo);
      return outgoing_density(smith.visible_density(wi, m), reflection_jacobian(dot(wi, m)));
    };
    CHECK(over_sphere(reflected) == Approx(1).margin(1e-3));
  }
}

TEST_CASE("the visible density has its limit at the horizon") {
  const Microsurface<Ggx, SmithSeparable> smith(kGgx, {0.3, 0.5});
  const Microsurface<ExactVCavity, VCavityMasking> cavities(kVCavity, {0.3, 0.5});
  const auto m = direction_at<double>(40, 30);
  const auto near = direction_at<double>(90 - 1e-7, 10);
  const Vec3<double> at{std::cos(10 * kDegree), std::sin(10 * kDegree), 0};
  CHECK(smith.visible_density(at, m) == Approx(smith.visible_density(near, m)).epsilon(1e-7));
  CHECK(cavities.visible_density(at, m) == Approx(cavities.visible_density(near, m)).epsilon(1e-7));
}

TEST_CASE("no surface reflects more than falls on it, and quadrature and samples agree how much") {
  std::uint64_t seed = 10;
  for_each_surface([&](const char* name, const auto& sampler, auto masking) {
    for (const auto& c : kConfigurations) {
      const auto wi = direction_at<double>(c.degrees, c.azimuth);
      const ConductorBrdf brdf(sampler, c.alpha, PerfectMirror<double>{}, masking);
      const double energy =
          over_hemisphere([&](const auto& wo) { return brdf.evaluate(wi, wo)[0]; });
      const Mean sampled =
          mean_of([&](double u1, double u2, double) { return brdf.sample(wi, u1, u2).weight[0]; },
                  20000, ++seed);
      CAPTURE(name, c.degrees, c.alpha.x, c.alpha.y, energy, sampled.error);
      CHECK(energy <= 1);
      CHECK(energy > 0.3);
      CHECK(std::abs(sampled.value - energy) < 4.5 * sampled.error + 1e-4);
    }
  });
}

TEST_CASE("no dielectric sends out more than falls on it, from either side, by both measures") {
  std::uint64_t seed = 100;
  for_each_surface([&](const char* name, const auto& sampler, auto masking) {
    for (const auto& c : kConfigurations)
      for (const double eta : {0.66, 1.5}) {
        const auto wi = direction_at<double>(c.degrees, c.azimuth);
        const DielectricBsdf bsdf(sampler, c.alpha, eta, masking);
        const auto energy_of = [&](bool above) {
          return over_hemisphere(
              [&](const auto& wo) { return bsdf.evaluate(wi, above ? wo : mirrored(wo)); }, 350);
        };
        const auto sampled_energy = [&](bool above) {
          return mean_of(
              [&](double u1, double u2, double u3) {
                const auto drawn = bsdf.sample(wi, u1, u2, u3);
                return (drawn.wo.z > 0) == above ? drawn.weight : 0;
              },
              20000, ++seed);
        };
        const double reflected = energy_of(true), transmitted = energy_of(false);
        CAPTURE(name, c.degrees, c.alpha.x, c.alpha.y, eta, reflected, transmitted);
        CHECK(reflected + transmitted <= 1);
        for (const bool above : {true, false}) {
          const Mean sampled = sampled_energy(above);
          CAPTURE(above, sampled.error);
          // Refraction ends at the critical angle with a jump, which the midpoint rule sees to
          // 1e-3.
          CHECK(std::abs(sampled.value - (above ? reflected : transmitted)) <
                4.5 * sampled.error + 1e-3);
        }
      }
  });
}

TEST_CASE("the mass of pdf is the part of the samples that is kept") {
  std::uint64_t seed = 1000;
  for_each_surface([&](const char* name, const auto& sampler, auto masking) {
    for (const auto& c : kConfigurations) {
      const auto wi = direction_at<double>(c.degrees, c.azimuth);
      const DielectricBsdf bsdf(sampler, c.alpha, 1.5, masking);
      const double mass = over_sphere([&](const auto& wo) { return bsdf.pdf(wi, wo); }, 350);
      const Mean kept =
          mean_of([&](double u1, double u2,
                      double u3) { return bsdf.sample(wi, u1, u2, u3).pdf > 0 ? 1.0 : 0.0; },
                  20000, ++seed);
      CAPTURE(name, c.degrees, c.alpha.x, c.alpha.y, mass);
      CHECK(std::abs(kept.value - mass) < 4.5 * kept.error + 2e-3);
    }
  });
}

TEST_CASE("what sample() returns is f cos / pdf and pdf of the direction drawn") {
  RandomInputs random(3);
  for_each_surface([&](const char* name, const auto& sampler, auto masking) {
    for (int i = 0; i < 2000; ++i) {
      const auto wi = random_direction(random, 89.9);
      const Alpha<double> alpha{0.05 + random.uniform(), 0.05 + random.uniform()};
      const double u1 = random.uniform(), u2 = random.uniform(), u3 = random.uniform();
      CAPTURE(name, i, wi.z, alpha.x, alpha.y, u1, u2, u3);

      const ConductorBrdf brdf(sampler, alpha, kGold, masking);
      if (const auto drawn = brdf.sample(wi, u1, u2); drawn.pdf > 0) {
        REQUIRE(brdf.pdf(wi, drawn.wo) == Approx(drawn.pdf).epsilon(kAgreement));
        const auto f = brdf.evaluate(wi, drawn.wo);
        for (std::size_t c = 0; c < 3; ++c)
          REQUIRE(f[c] / drawn.pdf == Approx(drawn.weight[c]).epsilon(kAgreement));
      }
      for (const double eta : {0.66, 1.5})
        for (const auto& w : {wi, mirrored(wi)}) {
          const DielectricBsdf bsdf(sampler, alpha, eta, masking);
          const auto drawn = bsdf.sample(w, u1, u2, u3);
          if (!(drawn.pdf > 0)) continue;
          CAPTURE(eta, drawn.wo.z);
          REQUIRE(bsdf.pdf(w, drawn.wo) == Approx(drawn.pdf).epsilon(kAgreement));
          REQUIRE(bsdf.evaluate(w, drawn.wo) / drawn.pdf ==
                  Approx(drawn.weight).epsilon(kAgreement).margin(1e-12));
        }
    }
  });
}

TEST_CASE("visible normals never weigh more than 1; all normals do, without bound under Smith") {
  RandomInputs random(4);
  double visible = 0, cavities = 0, all = 0, all_of_cavities = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto in = random.hard();
    const auto weight = [&](const auto& brdf) {
      return brdf.sample(in.wi, in.u1, in.u2).weight[0];
    };
    visible = std::max(visible, weight(Mirror<Ggx, SmithCorrelated>(kGgx, in.alpha, {})));
    cavities =
        std::max(cavities, weight(Mirror<ExactVCavity, VCavityMasking>(kVCavity, in.alpha, {})));
    all = std::max(all, weight(Mirror<AllGgx, SmithCorrelated>(kAllGgx, in.alpha, {})));
    all_of_cavities =
        std::max(all_of_cavities, weight(Mirror<AllGgx, VCavityMasking>(kAllGgx, in.alpha, {})));
  }
  CHECK(visible <= 1);
  CHECK(cavities <= 1);
  CHECK(all > 100);
  // Heitz and d'Eon 2014, Table 2.
  CHECK(all_of_cavities > 1.5);
  CHECK(all_of_cavities <= 2 * (1 + kAgreement));
}

TEST_CASE("Algorithm 1 weighs a normal by G2 (wi.wm) / (wi.z wm.z)") {
  const auto wi = direction_at<double>(70, 20);
  const Alpha<double> alpha{0.4, 0.7};
  const Mirror<AllGgx, SmithCorrelated> brdf(kAllGgx, alpha, {});
  for (const double u1 : {0.1, 0.35, 0.9})
    for (const double u2 : {0.2, 0.5}) {
      const auto m = kAllGgx.sample(wi, alpha, u1, u2);
      const auto wo = reflect(wi, m);
      const double expected =
          wo.z > 0 ? g2<SmithCorrelated>(kGgx, wi, wo, m, alpha) * dot(wi, m) / (wi.z * m.z) : 0;
      CHECK(brdf.sample(wi, u1, u2).weight[0] == Approx(expected));
    }
}

TEST_CASE("the third random number chooses reflection with the probability of Fresnel") {
  const auto wi = direction_at<double>(60);
  const DielectricBsdf bsdf(kGgx, {0.1, 0.1}, 1.5);
  const auto m = kGgx.sample(wi, {0.1, 0.1}, 0.3, 0.4);
  const double f = fresnel_dielectric(dot(wi, m), 1.5);
  CHECK(bsdf.sample(wi, 0.3, 0.4, f * 0.999).wo.z > 0);
  CHECK(bsdf.sample(wi, 0.3, 0.4, f * 1.001).wo.z < 0);
}

TEST_CASE("total internal reflection is reflected whatever the third random number") {
  const auto wi = direction_at<double>(60);
  const DielectricBsdf bsdf(kGgx, {0.01, 0.01}, 1 / 1.5);
  for (const double u3 : {0.0, 0.5, 1.0, 2.0}) {
    const auto drawn = bsdf.sample(wi, 0.3, 0.4, u3);
    CHECK(drawn.wo.z > 0);
    CHECK(drawn.weight > 0.9);
  }
}

TEST_CASE("between equal indices light passes straight through") {
  const auto wi = direction_at<double>(60, 10);
  const DielectricBsdf bsdf(kGgx, {0.5, 0.5}, 1.0);
  const auto drawn = bsdf.sample(wi, 0.3, 0.4, 0.0);
  CHECK((drawn.wo.x == -wi.x && drawn.wo.y == -wi.y && drawn.wo.z == -wi.z));
  CHECK(drawn.weight > 0.5);
  CHECK(drawn.pdf == 0);
  CHECK(bsdf.evaluate(wi, drawn.wo) == 0);
}

TEST_CASE("hard cases: finite and non-negative everywhere, visible weights at most 1") {
  check_hard_cases<double, Ggx, SmithCorrelated>(kGgx, 5, true);
  check_hard_cases<double, ExactVCavity, VCavityMasking>(kVCavity, 6, true);
  for (const char* distribution : {"ggx", "beckmann", "student-t:gamma=1.6", "pearson-ii:m=0"}) {
    check_hard_cases_of<float>(distribution);
    check_hard_cases_of<double>(distribution);
  }
}

TEST_CASE("an input outside its range gives 0") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Mirror<Ggx, SmithCorrelated> brdf(kGgx, {0.5, 0.5}, {});
  const DielectricBsdf bsdf(kGgx, {0.5, 0.5}, 1.5);
  const auto up = direction_at<double>(30), down = direction_at<double>(120);
  const std::vector<Vec3<double>> wrong{{nan, 0, 1}, {0, nan, 1}, {0, 0, nan}};
  CHECK(brdf.sample(down, 0.5, 0.5).weight[0] == 0);
  CHECK(brdf.evaluate(down, up)[0] == 0);
  CHECK(brdf.evaluate(up, down)[0] == 0);
  CHECK(brdf.pdf(up, down) == 0);
  CHECK(bsdf.evaluate(up, {1, 0, 0}) == 0);
  CHECK(bsdf.pdf(up, {1, 0, 0}) == 0);
  for (const auto& w : wrong) {
    CHECK(brdf.sample(w, 0.5, 0.5).weight[0] == 0);
    CHECK(brdf.evaluate(w, up)[0] == 0);
    CHECK(brdf.pdf(up, w) == 0);
    CHECK(bsdf.sample(w, 0.5, 0.5, 0.5).weight == 0);
    CHECK(bsdf.evaluate(w, up) == 0);
    CHECK(bsdf.evaluate(up, w) == 0);
    CHECK(bsdf.pdf(up, w) == 0);
  }
}

TEST_CASE("tables and the closed form give the same BSDF") {
  const TabulatedSampler<double> tabulated(small_tables("ggx").tables);
  const Alpha<double> alpha{0.3, 0.6};
  const Mirror<Ggx, SmithCorrelated> exact(kGgx, alpha, {});
  const Mirror<TabulatedSampler<double>, SmithCorrelated> brdf(tabulated, alpha, {});
  RandomInputs random(5);
  for (int i = 0; i < 500; ++i) {
    const auto wi = random_direction(random, 89.9), wo = random_direction(random, 89.9);
    REQUIRE(brdf.evaluate(wi, wo)[0] == Approx(exact.evaluate(wi, wo)[0]).epsilon(1e-7));
    REQUIRE(brdf.pdf(wi, wo) == Approx(exact.pdf(wi, wo)).epsilon(1e-7));
  }
}
