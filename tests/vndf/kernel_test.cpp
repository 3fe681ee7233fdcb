// The kernel: what it promises at every input, its density, its inverse and its functions.
#include "vndf/kernel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "support/baked_tables.h"
#include "support/catch.h"
#include "support/directions.h"
#include "support/random_inputs.h"
#include "vndf/bsdf/normal_sampler.h"
#include "vndf/support/low_discrepancy.h"
#include "vndf/tabulated_sampler.h"

using namespace vndf;
using namespace vndf::test;

static_assert(NormalSampler<Kernel, float>);

namespace {

const std::vector<std::string> kDistributions{"ggx", "beckmann", kMixture};

struct Input {
  Vec3<float> wi;
  Alpha<float> alpha;
  float u1, u2;
};

Input narrow(const SamplerInput& in) {
  const auto f = [](double v) { return static_cast<float>(v); };
  return {{f(in.wi.x), f(in.wi.y), f(in.wi.z)}, {f(in.alpha.x), f(in.alpha.y)}, f(in.u1), f(in.u2)};
}

std::vector<Input> hard_inputs(std::size_t count) {
  RandomInputs random(3);
  std::vector<Input> list;
  for (std::size_t k = 0; k < count; ++k) list.push_back(narrow(random.hard_anywhere()));
  return list;
}

Vec3<double> widen(const Vec3<float>& v) {
  return {v.x, v.y, v.z};
}

}  // namespace

TEST_CASE("every normal of a kernel is a unit vector above the horizon that faces wi") {
  for (const auto& distribution : kDistributions) {
    const Kernel kernel = baked_tables(distribution).kernel();
    double length = 0, away = 0;
    float lowest = 1;
    for (const Input& in : hard_inputs(50000)) {
      const Vec3<float> wm = kernel.sample(in.wi, in.alpha, in.u1, in.u2);
      const Vec3<double> m = widen(wm);
      length = std::max(length, std::abs(std::sqrt(dot(m, m)) - 1));
      away = std::max(away, -dot(widen(in.wi), m));
      lowest = std::min(lowest, wm.z);
    }
    CAPTURE(distribution);
    CHECK(length <= double{kLengthSlack<float>});
    CHECK(away <= double{kFacingSlack<float>});
    CHECK(lowest > 0);
  }
}

TEST_CASE("many normals of one direction are those drawn one by one, with or without density") {
  for (const auto& distribution : kDistributions) {
    const Kernel kernel = baked_tables(distribution).kernel();
    std::size_t different = 0;
    for (const Input& in : hard_inputs(20000)) {
      const Vec3<float> wm = kernel.sample(in.wi, in.alpha, in.u1, in.u2);
      const KernelDirection direction = kernel.at(in.wi, in.alpha);
      different += !same(wm, direction.sample(in.u1, in.u2)) ||
                   !same(wm, direction.sample_with_density(in.u1, in.u2).wm) ||
                   !same(wm, kernel.sample_with_density(in.wi, in.alpha, in.u1, in.u2).wm);
    }
    CAPTURE(distribution);
    CHECK(different == 0);
  }
}

TEST_CASE("an input outside its range gives the fallback") {
  const Kernel kernel = baked_tables("ggx").kernel();
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const Vec3<float> wi{0.6f, 0, 0.8f}, up{0, 0, 1};
  const auto falls_back = [&](const Vec3<float>& w, const Alpha<float>& alpha) {
    const SampledNormal<float> sampled = kernel.sample_with_density(w, alpha, 0.3f, 0.6f);
    CAPTURE(w.x, w.y, w.z, alpha.x, alpha.y);
    CHECK(same(sampled.wm, up));
    CHECK(sampled.pdf == 0);
    CHECK(kernel.pdf(w, up, alpha) == 0);
    CHECK_FALSE(kernel.invert(w, up, alpha));
  };
  falls_back({0.6f, kNan, 0.8f}, {1, 1});
  falls_back({kInfinity, 0, 0.8f}, {1, 1});
  falls_back({0.6f, 0, kNan}, {1, 1});
  for (const float alpha : {0.0f, -1.0f, kNan}) {
    falls_back(wi, {alpha, 1});
    falls_back(wi, {1, alpha});
    CHECK(kernel.d(up, {alpha, 1}) == 0);
    CHECK(kernel.g1(wi, {alpha, 1}) == 0);
    CHECK(kernel.lambda(wi, {1, alpha}) == 0);
  }
  CHECK(kernel.d({0.6f, 0, -0.8f}, {1, 1}) == 0);
  CHECK(kernel.d({1, 0, 0}, {1, 1}) == 0);
}

TEST_CASE("any u is moved into the range of u") {
  const Kernel kernel = baked_tables("ggx").kernel();
  const Vec3<float> wi{0.6f, 0, 0.8f};
  const auto sample = [&](float u1, float u2) { return kernel.sample(wi, {1, 1}, u1, u2); };
  const float least = 0x1p-25f, most = 1 - 0x1p-24f;
  for (const float u : {0.0f, -1.0f, -std::numeric_limits<float>::infinity(),
                        std::numeric_limits<float>::denorm_min()}) {
    CHECK(same(sample(u, 0.5f), sample(least, 0.5f)));
    CHECK(same(sample(0.5f, u), sample(0.5f, least)));
  }
  for (const float u : {1.0f, 2.0f, std::numeric_limits<float>::infinity()}) {
    CHECK(same(sample(u, 0.5f), sample(most, 0.5f)));
    CHECK(same(sample(0.5f, u), sample(0.5f, most)));
  }
  CHECK(finite_unit(sample(std::nanf(""), 0.5f)));
}

TEST_CASE("normals change little from the pole to directions next to it, and from half to half") {
  for (const auto& distribution : kDistributions) {
    const Kernel kernel = baked_tables(distribution).kernel();
    double pole = 0, half = 0;
    for (std::size_t k = 0; k < 1000; ++k) {
      const float u1 = static_cast<float>(support::golden(k)),
                  u2 = static_cast<float>(support::golden(k, 0.2));
      const auto distance = [](const Vec3<float>& a, const Vec3<float>& b) {
        return double{std::hypot(a.x - b.x, a.y - b.y, a.z - b.z)};
      };
      const Vec3<float> at_pole = kernel.sample({0, 0, 1}, {0.5f, 0.3f}, u1, u2);
      for (const double theta : {1e-7, 1e-5, 1e-4})
        pole = std::max(pole, distance(at_pole, kernel.sample(direction_at<float>(theta),
                                                              {0.5f, 0.3f}, u1, u2)));
      const KernelDirection direction = kernel.at(direction_at<float>(40, 70), {0.5f, 0.3f});
      const float below = std::nextafter(0.5f, 0.0f), above = std::nextafter(0.5f, 1.0f);
      half = std::max({half, distance(direction.sample(below, u2), direction.sample(above, u2)),
                       distance(direction.sample(u1, below), direction.sample(u1, above)),
                       distance(direction.sample(u1, 0.5f), direction.sample(u1, above)),
                       distance(direction.sample(0.5f, u2), direction.sample(above, u2))});
    }
    CAPTURE(distribution);
    CHECK(pole <= 1e-5);  // a slope changes by some 1e-4 degrees
    CHECK(half <= 1e-5);  // the gap of two halves within their rounding and the tolerance
  }
}

TEST_CASE("the mean of a density over that of the map is its integral") {
  // Points so even leave an error of some 1 / count.
  constexpr std::size_t kCount = 1 << 16;
  constexpr double kError = 1e-3;
  for (const auto& distribution : kDistributions)
    for (const double theta : {0.0, 30.0, 70.0, 89.0}) {
      const Kernel kernel = baked_tables(distribution).kernel();
      const Vec3<float> wi = direction_at<float>(theta, 30);
      const Alpha<float> alpha{0.7f, 0.4f};
      const KernelDirection direction = kernel.at(wi, alpha);
      double sum = 0;
      for (std::size_t k = 0; k < kCount; ++k) {
        const double u1 = (static_cast<double>(k) + 0.5) / kCount;
        const auto [wm, pdf] = direction.sample_with_density(
            static_cast<float>(u1), static_cast<float>(support::golden(k)));
        sum += double{kernel.pdf(wi, wm, alpha)} / double{pdf};
      }
      CAPTURE(distribution, theta);
      CHECK(sum / kCount == Approx(1).margin(kError));
    }
}

TEST_CASE("the inverse of a normal is the u that it was drawn with") {
  // The rounding of a normal, in u, where it is not at the end of a tail or of visibility.
  constexpr double kRounding = 4e-6;
  for (const auto& distribution : kDistributions) {
    const Kernel kernel = baked_tables(distribution).kernel();
    double largest = 0;
    std::size_t lost = 0;
    for (std::size_t k = 0; k < 20000; ++k) {
      const double theta = 85 * support::golden(k, 0.7);
      const Vec3<float> wi = direction_at<float>(theta, 360 * support::golden(3 * k));
      const Alpha<float> alpha{0.6f, 0.3f};
      const float u1 = static_cast<float>(0.01 + 0.98 * support::golden(k)),
                  u2 = static_cast<float>(0.01 + 0.98 * support::golden(2 * k, 0.2));
      const auto u = kernel.invert(wi, kernel.sample(wi, alpha, u1, u2), alpha);
      lost += !u;
      if (u)
        largest = std::max({largest, double{std::abs(u->x - u1)}, double{std::abs(u->y - u2)}});
    }
    CAPTURE(distribution);
    CHECK(lost == 0);
    CHECK(largest <= kRounding);
  }
}

TEST_CASE("D, Lambda, G1 and the density are those of the pair") {
  // Curves follow the pair to the tolerance; two of them make a density.
  constexpr double kRelative = 2 * kBakedWithin;
  for (const auto& distribution : kDistributions) {
    const Kernel kernel = baked_tables(distribution).kernel();
    const TabulatedSampler<double> pair(small_tables(distribution).tables);
    const Alpha<float> alpha{0.6f, 0.3f};
    const Alpha<double> wide{alpha.x, alpha.y};
    for (std::size_t k = 0; k < 2000; ++k) {
      const Vec3<float> wi =
          direction_at<float>(89.9 * support::golden(k), 360 * support::golden(3 * k));
      const Vec3<float> wm = kernel.sample(wi, alpha, static_cast<float>(support::golden(k, 0.2)),
                                           static_cast<float>(support::golden(2 * k)));
      CAPTURE(distribution, wi.z, wm.x, wm.y, wm.z);
      CHECK(double{kernel.d(wm, alpha)} == Approx(pair.d(widen(wm), wide)).epsilon(kRelative));
      CHECK(1 + double{kernel.lambda(wi, alpha)} ==
            Approx(1 + pair.lambda(widen(wi), wide)).epsilon(kRelative));
      CHECK(double{kernel.g1(wi, alpha)} == Approx(pair.g1(widen(wi), wide)).epsilon(kRelative));
      const double facing = pair.d(widen(wm), wide) * pair.g1(widen(wi), wide) / double{wi.z};
      CHECK(double{kernel.pdf(wi, wm, alpha)} ==
            Approx(pair.pdf(widen(wi), widen(wm), wide)).margin(kRelative * facing));
    }
  }
}

TEST_CASE("Lambda is infinite at the horizon and 0 at the pole, where G1 is 0 and 1") {
  const Kernel kernel = baked_tables("beckmann").kernel();
  CHECK(std::isinf(kernel.lambda({1, 0, 0}, {1, 1})));
  CHECK(kernel.g1({1, 0, 0}, {1, 1}) == 0);
  CHECK(kernel.lambda({0, 0, 1}, {1, 1}) == 0);
  CHECK(kernel.g1({0, 0, 1}, {1, 1}) == 1);
  CHECK(kernel.lambda({0.6f, 0, -0.8f}, {1, 1}) == kernel.lambda({0.6f, 0, 0.8f}, {1, 1}));
}
