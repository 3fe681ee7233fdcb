// What both samplers promise of every normal and density, asked at inputs where they could break
// it: u = 0 and 1, directions at and next to the poles and the horizon, any roughness. Each way to
// draw from a kernel, one by one, prepared and in batches, gives the same normal to the last bit.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "support/batch_arrays.h"
#include "support/built_tables.h"
#include "support/catch.h"
#include "support/directions.h"
#include "support/random_inputs.h"
#include "vndf/baking/bake.h"
#include "vndf/batch/sample_batch.h"
#include "vndf/tabulated_sampler.h"

using namespace vndf;
using namespace vndf::test;

namespace {

/// A distribution, and the tolerance in u with which its tables can be baked from a small pair.
struct Baked {
  const char* distribution;
  double tolerance;
};

/// Light, heavy and compact tails, a cusp, and scales at 1:100.
const std::vector<Baked> kBaked{{"ggx", 1e-4},
                                {"beckmann", 1e-4},
                                {"student-t:gamma=1.6", 1e-4},
                                {"exponential-power:p=0.5", 1e-3},
                                {"annulus:inner=0.5", 1e-2},
                                {"mixture:0.9*ggx+0.1*beckmann@0.01", 1e-2}};

bool same_bits(const Vec3<float>& a, const Vec3<float>& b) {
  const auto same = [](float p, float q) {
    return std::bit_cast<std::uint32_t>(p) == std::bit_cast<std::uint32_t>(q);
  };
  return same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z);
}

Vec3<double> widened(const Vec3<float>& v) {
  return {v.x, v.y, v.z};
}

/// A number that is neither negative nor infinite nor none.
bool finite_and_not_negative(float a) {
  return a >= 0 && std::isfinite(a);
}

/// How many inputs broke each promise, and the largest errors of the normals.
struct Counts {
  std::size_t infinite = 0, length = 0, below = 0, away = 0, density = 0, functions = 0, other = 0;
  std::size_t unseen = 0;  ///< directions below the horizon from which nothing is visible
  double worst_length = 0, worst_away = 0;

  std::size_t all() const { return infinite + length + below + away + density + functions + other; }

  void see_normal(const Vec3<float>& wi, const Vec3<float>& wm) {
    const Vec3<double> m = widened(wm);
    const double off = std::abs(std::sqrt(dot(m, m)) - 1), hidden = -dot(widened(wi), m);
    if (!std::isfinite(off)) {
      ++infinite;
      return;
    }
    worst_length = std::max(worst_length, off);
    worst_away = std::max(worst_away, hidden);
    length += off > double{kLengthSlack<float>};
    away += hidden > double{kFacingSlack<float>};
    below += wm.z < 0;
  }

  /// The densities of a normal and the functions of the direction. Lambda is beyond the largest
  /// float next to the horizon, and infinite there.
  template <class Sampler>
  void see_functions(const Sampler& s, const Vec3<float>& wi, const Alpha<float>& alpha,
                     const SampledNormal<float>& drawn) {
    density +=
        !finite_and_not_negative(drawn.pdf) || !finite_and_not_negative(s.pdf(wi, drawn.wm, alpha));
    const float g1 = s.g1(wi, alpha), lambda = s.lambda(wi, alpha);
    functions += !finite_and_not_negative(s.d(drawn.wm, alpha)) || !(g1 >= 0 && g1 <= 1) ||
                 !(lambda >= 0) || (std::isinf(lambda) && std::abs(wi.z) > 1e-30f);
  }

  template <class Sampler>
  void see(const Sampler& s, const Vec3<float>& wi, const Alpha<float>& alpha, float u1, float u2) {
    const Vec3<float> wm = s.sample(wi, alpha, u1, u2);
    const SampledNormal<float> drawn = s.sample_with_density(wi, alpha, u1, u2);
    if (wi.z < 0 && drawn.pdf == 0 && same_bits(wm, {0, 0, 1}))
      ++unseen;
    else
      see_normal(wi, wm);
    see_functions(s, wi, alpha, drawn);
    other += !same_bits(wm, drawn.wm);
  }
};

/// The other ways to draw from a kernel: a prepared direction and a batch.
void see_other_ways(const Kernel& kernel, BatchArrays& batch, Counts& counts) {
  sample_batch(kernel, batch.wi(), batch.alpha(), batch.u1, batch.u2, batch.wm());
  for (std::size_t i = 0; i < batch.size(); ++i) {
    const Vec3<float> wi = batch.wi(i);
    const Alpha<float> alpha = batch.alpha(i);
    const Vec3<float> wm = kernel.sample(wi, alpha, batch.u1[i], batch.u2[i]);
    const Vec3<float> prepared = kernel.at(wi, alpha).sample(batch.u1[i], batch.u2[i]);
    counts.other += !same_bits(wm, prepared) || !same_bits(wm, batch.normal(i));
  }
}

/// Of unbounded slopes some are visible from everywhere.
void check(const std::string& what, std::size_t inputs, const Counts& c, bool bounded) {
  CAPTURE(what, inputs, c.infinite, c.length, c.below, c.away, c.density, c.functions, c.other,
          c.worst_length, c.worst_away);
  CHECK(c.all() == 0);
  CHECK((c.unseen > 0) == bounded);
}

/// Draws `inputs` normals from the pair and from the kernel of every distribution.
void check_hard_inputs(std::size_t inputs, std::uint64_t seed, bool report) {
  constexpr std::size_t kBatch = 1000;
  for (const auto& [distribution, tolerance] : kBaked) {
    const auto& tables = small_tables(distribution).tables;
    const TabulatedSampler<float> pair(tables);
    const KernelTables baked =
        bake(*tables, {.tolerance = tolerance, .max_bytes = std::size_t{1} << 20});
    const Kernel kernel = baked.kernel();
    RandomInputs random(seed);
    Counts of_pair, of_kernel;
    const bool bounded = std::isfinite(tables->support);
    for (std::size_t done = 0; done < inputs; done += kBatch) {
      BatchArrays batch;
      for (std::size_t i = 0; i < kBatch; ++i) batch.add(random.hard_anywhere());
      for (std::size_t i = 0; i < kBatch; ++i) {
        of_pair.see(pair, batch.wi(i), batch.alpha(i), batch.u1[i], batch.u2[i]);
        of_kernel.see(kernel, batch.wi(i), batch.alpha(i), batch.u1[i], batch.u2[i]);
      }
      see_other_ways(kernel, batch, of_kernel);
    }
    check(std::string(distribution) + ", pair", inputs, of_pair, bounded);
    check(std::string(distribution) + ", kernel", inputs, of_kernel, bounded);
    if (report)
      WARN(distribution << ": " << inputs << " inputs, broken promises: pair " << of_pair.all()
                        << ", kernel " << of_kernel.all() << "; facing away at most "
                        << of_pair.worst_away << ", " << of_kernel.worst_away
                        << "; length off by at most " << of_pair.worst_length << ", "
                        << of_kernel.worst_length);
  }
}

TabulatedSampler<float> pair_of(const char* distribution) {
  return TabulatedSampler<float>(small_tables(distribution).tables);
}

}  // namespace

TEST_CASE(
    "hard inputs give unit normals that face wi, finite densities, and one normal in every "
    "way to draw it") {
  check_hard_inputs(50000, 5, false);
}

TEST_CASE("as many hard inputs as VNDF_HARD_INPUTS says, 1e8 if it is not set", "[.slow]") {
  const char* given = std::getenv("VNDF_HARD_INPUTS");
  check_hard_inputs(given ? static_cast<std::size_t>(std::strtod(given, nullptr)) : 100000000,
                    std::random_device{}(), true);
}

TEST_CASE("at u1 = 1 the normals of a heavy tail face wi, however much roughness stretches them") {
  const auto pair = pair_of("student-t:gamma=1.6");
  double away = 0;
  for (int k = 1; k < 90; ++k)
    for (const float u2 : {0.01f, 0.3f, 0.5f, 0.7f, 0.99f}) {
      const Vec3<float> wi = direction_at<float>(k, 7 * k);
      const Vec3<float> wm = pair.sample(wi, {0.04f, 7}, 1, u2);
      away = std::max(away, -dot(widened(wi), widened(wm)));
    }
  CHECK(away <= double{kFacingSlack<float>});
}

TEST_CASE("the normal of a direction whose horizontal part cannot be squared has length 1") {
  const auto pair = pair_of("beckmann");
  for (const float x : {1.23413414e-22f, 1e-21f, 1e-30f, 1e-38f, 1e-44f})
    for (const float u2 : {0.0f, 1.0f}) {
      const Vec3<double> m = widened(pair.sample({x, x, 1}, {0.947f, 0.947f}, 1, u2));
      CAPTURE(x, u2);
      CHECK(std::sqrt(dot(m, m)) == Approx(1).margin(double{kLengthSlack<float>}));
    }
}

TEST_CASE("where both slopes are infinite the normal is horizontal, whatever the scale of y") {
  for (const auto& [distribution, tolerance] : kBaked) {
    if (std::string(distribution).starts_with("annulus")) continue;  // whose slopes are finite
    const auto pair = pair_of(distribution);
    for (const float u2 : {0.0f, 1.0f}) {
      CAPTURE(distribution, u2);
      CHECK(pair.sample({0.6f, 0, 0.8f}, {0.5f, 0.3f}, 0, u2).z == 0);
    }
  }
}

TEST_CASE("a vector of any finite length is normalised") {
  for (const float size : {1e-44f, 1e-30f, 1e-20f, 1.0f, 1e20f, 3e38f}) {
    const Vec3<float> unit = normalize_or_up(Vec3<float>{size, 0, -size});
    CAPTURE(size);
    CHECK(unit.x == Approx(std::sqrt(0.5)).epsilon(1e-6));
    CHECK(unit.z == -unit.x);
  }
  for (const float none : {0.0f, INFINITY, -INFINITY, NAN}) {
    const Vec3<float> up = normalize_or_up(Vec3<float>{none, 0, 0});
    CHECK((up.x == 0 && up.y == 0 && up.z == 1));
  }
}
