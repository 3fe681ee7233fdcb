// Baking: the kernel's tables follow the pair, within what was asked for.
#include "vndf/baking/bake.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "support/baked_tables.h"
#include "support/catch.h"
#include "support/directions.h"
#include "support/kernel_portable.h"
#include "support/random_inputs.h"
#include "vndf/support/low_discrepancy.h"
#include "vndf/tabulated_sampler.h"

using namespace vndf;
using namespace vndf::test;

namespace {

const std::vector<std::string> kDistributions{"ggx", "beckmann", kMixture};

/// Single-precision numbers in [0, 1] where cells may begin, with their neighbours, and others.
std::vector<float> hard_numbers() {
  std::vector<float> list{0, 1};
  for (int octave = 1; octave < 26; ++octave)
    for (int part = 8; part < 16; ++part) {
      const float u = std::ldexp(static_cast<float>(part), -octave - 3);
      for (const float v : {u, 1 - u})
        for (const float near : {std::nextafter(v, 0.0f), v, std::nextafter(v, 2.0f)})
          if (near < 1) list.push_back(near);
    }
  for (std::size_t k = 0; k < 2000; ++k) list.push_back(static_cast<float>(support::golden(k)));
  std::sort(list.begin(), list.end());
  return list;
}

kernel::VndfDirection direction(const Kernel& kernel, double theta) {
  return kernel.at(direction_at<float>(theta), {1, 1}).view().direction;
}

/// The largest difference in u from the pair, of normals drawn at `theta`; the pair's own inverse
/// tells for which u it gives the same normal.
double difference(const std::string& distribution, double theta) {
  constexpr std::size_t kPlaces = 3000;
  const Kernel kernel = baked_tables(distribution).kernel();
  const TabulatedSampler<double> pair(small_tables(distribution).tables);
  const Vec3<float> wi = direction_at<float>(theta);
  double largest = 0;
  for (std::size_t k = 0; k < kPlaces; ++k) {
    const float u1 = static_cast<float>(support::golden(k)),
                u2 = static_cast<float>(support::golden(k, 0.1));
    const Vec3<float> m = kernel.sample(wi, {1, 1}, u1, u2);
    const auto u = pair.invert({wi.x, wi.y, wi.z}, {m.x, m.y, m.z}, {1, 1});
    if (!u) return 1;
    largest = std::max({largest, std::abs(u->x - u1), std::abs(u->y - u2)});
  }
  return largest;
}

}  // namespace

TEST_CASE("a kernel differs from its pair by no more than the tolerance") {
  // The rounding of a single-precision normal, in u.
  constexpr double kRounding = 1e-6;
  for (const auto& distribution : kDistributions)
    for (const double theta : {1.0, 30.0, 60.0, 80.0}) {
      CAPTURE(distribution, theta);
      CHECK(difference(distribution, theta) <= kBakedWithin + kRounding);
    }
}

TEST_CASE("a smaller tolerance takes more bytes") {
  const SlopeTables& pair = *small_tables("ggx").tables;
  const auto bytes = [&](double tolerance) {
    return bake(pair, {.tolerance = tolerance}).sampling_bytes();
  };
  CHECK(bytes(1e-5) > bytes(1e-3));
  CHECK(bytes(1e-4) > bytes(1e-2));
}

TEST_CASE("what does not fit the bytes is an error that says what would fit") {
  const SlopeTables& pair = *small_tables("ggx").tables;
  const std::size_t needed = bake(pair, {.tolerance = 1e-2}).sampling_bytes();
  CHECK_NOTHROW(bake(pair, {.tolerance = 1e-2, .max_bytes = needed}));
  CHECK_THROWS_AS(bake(pair, {.tolerance = 1e-2, .max_bytes = 64}), BakeError);
}

TEST_CASE("a tolerance outside its range is an error") {
  const SlopeTables& pair = *small_tables("ggx").tables;
  for (const double tolerance : {0.0, -1e-5, 1e-7, 0.1, std::nan("")})
    CHECK_THROWS_AS(bake(pair, {.tolerance = tolerance}), std::invalid_argument);
}

TEST_CASE("the same pair gives the same bytes") {
  const SlopeTables& pair = *small_tables(kMixture).tables;
  const KernelTables again = bake(pair, {.tolerance = kBakedWithin});
  CHECK(std::ranges::equal(again.bytes(), baked_tables(kMixture).bytes()));
}

TEST_CASE("slope x never decreases with u1 nor slope y with u2, but for their rounding") {
  // The roundings of a cubic; of a value near 0 those of the others in its cell, and of a root in
  // the far tail, where the map makes it of s, those of s. The map changes the root by up to twice
  // the part that s changes, and s is rounded as often.
  constexpr double kRounded = 4 * 0x1p-23, kSmallest = 0.1;
  const std::vector<float> us = hard_numbers();
  for (const auto& distribution : kDistributions)
    for (const double theta : {0.0, 1e-3, 20.0, 60.0, 85.0, 90.0}) {
      const Kernel kernel = baked_tables(distribution).kernel();
      const auto w = direction(kernel, theta);
      float root = 0, v = -std::numeric_limits<float>::infinity();
      double worst_root = 0, worst_v = 0;
      for (const float u : us) {
        const auto x = vndf_draw(kernel.tables(), w, u, 0.5f);
        const auto y = vndf_draw(kernel.tables(), w, 0.3f, u);
        worst_root =
            std::max(worst_root, double{root - x.root} / std::max(double{x.root}, kSmallest));
        worst_v = std::max(worst_v, (v - y.v) / std::max(double{std::abs(y.v)}, kSmallest));
        root = x.root;
        v = y.v;
      }
      CAPTURE(distribution, theta);
      CHECK(worst_root <= (kernel.tables().separable != 0 ? 1 : 3) * kRounded);
      CHECK(worst_v <= kRounded);
    }
}

TEST_CASE("the density has no steps along u1 and u2") {
  // Of coefficients in single precision, at the two sides of the border of two cells.
  constexpr double kStep = 5e-4;
  // Beyond which the next random number is farther than that.
  constexpr float kLeast = 1e-3f;
  for (const auto& distribution : kDistributions) {
    const Kernel kernel = baked_tables(distribution).kernel();
    const auto at = kernel.at(direction_at<float>(50), {1, 1});
    const auto step = [&](float u, auto density) {
      const float below = density(std::nextafter(u, 0.0f)), above = density(u);
      return std::abs(double{above} / double{below} - 1);
    };
    double along_u1 = 0, along_u2 = 0;
    for (const float u : hard_numbers()) {
      if (u < kLeast || u > 1 - kLeast) continue;
      along_u1 =
          std::max(along_u1, step(u, [&](float p) { return at.sample_with_density(p, 0.3f).pdf; }));
      along_u2 =
          std::max(along_u2, step(u, [&](float p) { return at.sample_with_density(0.3f, p).pdf; }));
    }
    CAPTURE(distribution);
    CHECK(along_u1 <= kStep);
    CHECK(along_u2 <= kStep);
  }
}

TEST_CASE("vectors and the portable code give the same bits") {
  RandomInputs random(7);
  for (const auto& distribution : kDistributions) {
    const Kernel kernel = baked_tables(distribution).kernel();
    std::size_t different = 0;
    for (int k = 0; k < 20000; ++k) {
      const SamplerInput in = random.hard_anywhere();
      const auto f = [](double v) { return static_cast<float>(v); };
      const KernelInput input{f(in.wi.x),    f(in.wi.y), f(in.wi.z), f(in.alpha.x),
                              f(in.alpha.y), f(in.u1),   f(in.u2)};
      const auto bits = [](const KernelAnswers& a) {
        return std::bit_cast<std::array<std::uint32_t, 6>>(a);
      };
      different += bits(answers_of<Kernel, Vec3<float>, Alpha<float>>(kernel, input)) !=
                   bits(portable_answers(&kernel.tables(), input));
    }
    CAPTURE(distribution);
    CHECK(different == 0);
  }
}
