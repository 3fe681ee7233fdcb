// Batches: to the last bit what the scalar kernel draws, on every target, for tables of every kind,
// at any length.
#include "vndf/batch/sample_batch.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "support/baked_tables.h"
#include "support/batch_arrays.h"
#include "support/catch.h"
#include "support/random_inputs.h"

using namespace vndf;
using namespace vndf::test;

namespace {

struct NamedTables {
  std::string name;
  KernelTables tables;
};

/// Tables of every kind: with rows of y in slope x and without, columns by q and, in few bytes, by
/// its root, each scale of y.
const std::vector<NamedTables>& all_kinds_of_tables() {
  static const std::vector<NamedTables> all = [] {
    std::vector<NamedTables> made;
    for (const auto& [distribution, kilobytes] :
         std::vector<std::pair<std::string, std::size_t>>{{"ggx", 256},
                                                          {"ggx", 16},
                                                          {"beckmann", 64},
                                                          {kMixture, 256},
                                                          {kMixture, 64},
                                                          {"disk", 256},
                                                          {"annulus:inner=0.5", 256}}) {
      const BakeOptions options{.tolerance = 1e-2, .max_bytes = 1024 * kilobytes};
      made.push_back({distribution + " in " + std::to_string(kilobytes) + " KiB",
                      bake(*small_tables(distribution).tables, options)});
    }
    return made;
  }();
  return all;
}

/// Runs `f` for tables of every kind on every target.
void for_each_kernel(const std::function<void(const Kernel&)>& f) {
  for (const auto& [name, tables] : all_kinds_of_tables())
    for_each_target([&, &distribution = name, &of = tables](const char* target) {
      CAPTURE(distribution, target);
      f(of.kernel());
    });
}

/// Whether they are one vector to the last bit, the sign of 0 included.
bool same_bits(const Vec3<float>& a, const Vec3<float>& b) {
  const auto same = [](float p, float q) {
    return std::bit_cast<std::uint32_t>(p) == std::bit_cast<std::uint32_t>(q);
  };
  return same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z);
}

void sample(const Kernel& kernel, BatchArrays& batch) {
  sample_batch(kernel, batch.wi(), batch.alpha(), batch.u1, batch.u2, batch.wm());
}

/// How many normals of the batch are not those of the scalar kernel, bit for bit.
std::size_t differences(const BatchArrays& batch, const Kernel& kernel) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < batch.size(); ++i)
    if (!same_bits(batch.normal(i),
                   kernel.sample(batch.wi(i), batch.alpha(i), batch.u1[i], batch.u2[i])))
      ++count;
  return count;
}

/// `n` random inputs, hard ones among them.
BatchArrays hard_batch(std::size_t n) {
  RandomInputs random(11);
  BatchArrays batch;
  for (std::size_t i = 0; i < n; ++i) batch.add(random.hard_anywhere());
  return batch;
}

constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInfinity = INFINITY;
constexpr float kSmallest = std::numeric_limits<float>::denorm_min();

const std::vector<Vec3<float>> kDirections{
    {0, 0, 1},         {-0.0f, 0, 1},     {1, 0, 0},         {0, -1, 0},       {0.6f, 0, 0.8f},
    {0, 1e-30f, 1},    {1e-7f, 0, 1},     {kSmallest, 0, 1}, {0.6f, 0, -0.0f}, {0.6f, 0, -0.8f},
    {0, 0, -1},        {0, 0, 0},         {kNan, 0, 1},      {0, kNan, 1},     {0.6f, 0, kNan},
    {kInfinity, 0, 1}, {0, 0, kInfinity}, {0, -kInfinity, 0}};
const std::vector<Alpha<float>> kAlphas{
    {0.5f, 0.5f}, {10, 1e-4f}, {1e-4f, 1}, {kSmallest, 1}, {0, 1},         {1, 0},
    {1, -1},      {kNan, 1},   {1, kNan},  {kInfinity, 1}, {1, kInfinity}, {1e30f, 1e30f}};
const std::vector<float> kNumbers{0, kSmallest, 0.25f, 0.5f, 0.75f,    1 - 0x1p-24f,
                                  1, -1,        2,     kNan, kInfinity};

BatchArrays extreme_batch() {
  BatchArrays batch;
  for (const auto& wi : kDirections)
    for (const auto& alpha : kAlphas)
      for (const float u1 : kNumbers)
        for (const float u2 : kNumbers) batch.add(wi, alpha, u1, u2);
  return batch;
}

/// The last `n` samples of `all`.
BatchArrays end_of(const BatchArrays& all, std::size_t n) {
  BatchArrays end;
  for (std::size_t i = all.size() - n; i < all.size(); ++i)
    end.add(all.wi(i), all.alpha(i), all.u1[i], all.u2[i]);
  return end;
}

}  // namespace

TEST_CASE("the tables of these tests are of every kind") {
  std::set<std::pair<bool, bool>> layouts;
  std::set<std::pair<bool, bool>> scales;
  for (const auto& [name, tables] : all_kinds_of_tables()) {
    const kernel::VndfTables t = tables.kernel().tables();
    layouts.insert({t.separable != 0, t.column_roots != 0});
    scales.insert({t.rim > 0, t.scale_root > 0});
  }
  CHECK(layouts.size() == 4);
  CHECK(scales.size() == 3);  // a rim, a root and a constant
}

TEST_CASE("a batch draws what the scalar kernel draws, to the last bit") {
  BatchArrays batch = hard_batch(20000);
  for_each_kernel([&](const Kernel& kernel) {
    sample(kernel, batch);
    CHECK(differences(batch, kernel) == 0);
  });
}

TEST_CASE("the comparison with the scalar kernel sees one bit of a normal") {
  const KernelTables& tables = baked_tables(kMixture);
  BatchArrays batch = hard_batch(100);
  sample(tables.kernel(), batch);
  batch.y[70] = std::nextafter(batch.y[70], 2.0f);
  CHECK(differences(batch, tables.kernel()) == 1);
}

TEST_CASE("inputs at and outside the ends of their ranges give what the scalar kernel gives") {
  BatchArrays batch = extreme_batch();
  for_each_kernel([&](const Kernel& kernel) {
    sample(kernel, batch);
    CHECK(differences(batch, kernel) == 0);
  });
}

TEST_CASE("unusual directions do not touch the samples beside them") {
  const BatchArrays usual = hard_batch(300);
  BatchArrays mixed;
  for (std::size_t i = 0; i < usual.size(); ++i) {
    const auto& wi = kDirections[i % kDirections.size()];
    if (i % 3 == 0)
      mixed.add(wi, usual.alpha(i), usual.u1[i], usual.u2[i]);
    else
      mixed.add(usual.wi(i), usual.alpha(i), usual.u1[i], usual.u2[i]);
  }
  for_each_kernel([&](const Kernel& kernel) {
    sample(kernel, mixed);
    CHECK(differences(mixed, kernel) == 0);
  });
}

TEST_CASE("a sample does not depend on its place in a batch or on the length of the batch") {
  const KernelTables& tables = baked_tables(kMixture);
  const BatchArrays whole = hard_batch(200);
  for_each_target([&](const char* target) {
    CAPTURE(target);
    for (std::size_t n = 0; n <= whole.size(); ++n) {
      BatchArrays end = end_of(whole, n);
      sample(tables.kernel(), end);
      REQUIRE(differences(end, tables.kernel()) == 0);
    }
  });
}

TEST_CASE("a batch writes its normals and nothing else") {
  const KernelTables& tables = baked_tables(kMixture);
  constexpr std::size_t kSize = 77, kMargin = 64;
  const BatchArrays in = hard_batch(kSize);
  for_each_target([&](const char* target) {
    CAPTURE(target);
    std::vector<float> out[3];
    for (auto& v : out) v.assign(kSize + 2 * kMargin, -9);
    const auto inner = [&](int k) { return std::span(out[k]).subspan(kMargin, kSize); };
    sample_batch(tables.kernel(), in.wi(), in.alpha(), in.u1, in.u2,
                 {inner(0), inner(1), inner(2)});
    for (const auto& v : out)
      for (std::size_t i = 0; i < kMargin; ++i)
        REQUIRE((v[i] == -9 && v[kMargin + kSize + i] == -9));
  });
}

TEST_CASE("one roughness for all is that roughness given for each") {
  const KernelTables& tables = baked_tables(kMixture);
  BatchArrays batch = hard_batch(90);
  batch.alpha_x.assign(batch.size(), 0.25f);
  batch.alpha_y.assign(batch.size(), 0.5f);
  for_each_target([&](const char* target) {
    CAPTURE(target);
    sample_batch(tables.kernel(), batch.wi(), Alpha<float>{0.25f, 0.5f}, batch.u1, batch.u2,
                 batch.wm());
    CHECK(differences(batch, tables.kernel()) == 0);
  });
}

TEST_CASE("a batch of one direction draws what the direction draws, to the last bit") {
  BatchArrays batch = hard_batch(150);
  const BatchArrays directions = hard_batch(40);
  const auto differences_from = [&](const KernelDirection& at) {
    sample_batch(at, batch.u1, batch.u2, batch.wm());
    std::size_t count = 0;
    for (std::size_t i = 0; i < batch.size(); ++i)
      if (!same_bits(batch.normal(i), at.sample(batch.u1[i], batch.u2[i]))) ++count;
    return count;
  };
  for_each_kernel([&](const Kernel& kernel) {
    for (std::size_t i = 0; i < directions.size(); ++i)
      CHECK(differences_from(kernel.at(directions.wi(i), directions.alpha(i))) == 0);
    for (const auto& wi : kDirections)
      for (const auto& alpha : kAlphas) CHECK(differences_from(kernel.at(wi, alpha)) == 0);
    sample_batch(kernel.at({0, 0, 1}, {1, 1}), {}, {}, {});
  });
}

/// Surfaces with correlated slopes, with a mean slope, and with all of it.
const std::vector<RoughSurface<float>> kSurfaces{
    RoughSurface<float>::correlated({0.25f, 0.5f}, -0.95f),
    RoughSurface<float>::correlated({0.3f, 0.3f}, 0, {0.7f, -0.4f}),
    RoughSurface<float>::correlated({0.1f, 1}, 0.5f, {2, 1}),
    RoughSurface<float>::correlated({kNan, 1}, 0.5f, {2, 1})};

TEST_CASE("a batch on a surface draws what the scalar kernel draws there, to the last bit") {
  BatchArrays batch = hard_batch(2000);
  for (const auto& wi : kDirections)
    for (const float u : kNumbers) batch.add(wi, {1, 1}, u, 0.3f);
  for_each_kernel([&](const Kernel& kernel) {
    for (const RoughSurface<float>& surface : kSurfaces) {
      sample_batch(kernel, batch.wi(), surface, batch.u1, batch.u2, batch.wm());
      std::size_t different = 0;
      for (std::size_t i = 0; i < batch.size(); ++i) {
        const auto wm = kernel.sample(batch.wi(i), surface, batch.u1[i], batch.u2[i]);
        if (!same_bits(batch.normal(i), wm)) ++different;
      }
      CHECK(different == 0);
    }
  });
}

TEST_CASE("a batch of one direction on a surface draws what the direction draws") {
  BatchArrays batch = hard_batch(150);
  for_each_kernel([&](const Kernel& kernel) {
    for (const RoughSurface<float>& surface : kSurfaces)
      for (const auto& wi : kDirections) {
        const KernelDirection at = kernel.at(wi, surface);
        sample_batch(at, batch.u1, batch.u2, batch.wm());
        std::size_t different = 0;
        for (std::size_t i = 0; i < batch.size(); ++i)
          if (!same_bits(batch.normal(i), at.sample(batch.u1[i], batch.u2[i]))) ++different;
        CHECK(different == 0);
      }
  });
}

TEST_CASE("spans that differ in size are named in an error") {
  const KernelTables& tables = baked_tables(kMixture);
  const std::vector<std::pair<std::string, std::vector<float> BatchArrays::*>> spans{
      {"wi.x", &BatchArrays::wi_x},       {"wi.y", &BatchArrays::wi_y},
      {"wi.z", &BatchArrays::wi_z},       {"alpha.x", &BatchArrays::alpha_x},
      {"alpha.y", &BatchArrays::alpha_y}, {"u1", &BatchArrays::u1},
      {"u2", &BatchArrays::u2},           {"wm.y", &BatchArrays::y},
      {"wm.z", &BatchArrays::z}};
  for (const auto& [name, member] : spans) {
    BatchArrays batch = hard_batch(3);
    (batch.*member).pop_back();
    const auto message = contains(name + " has 2 values where wm.x has 3");
    CHECK_THROWS_WITH(sample(tables.kernel(), batch), message);
    if (name.starts_with("alpha")) continue;
    CHECK_THROWS_WITH(sample_batch(tables.kernel(), batch.wi(), Alpha<float>{1, 1}, batch.u1,
                                   batch.u2, batch.wm()),
                      message);
    if (name.starts_with("wi")) continue;
    CHECK_THROWS_WITH(
        sample_batch(tables.kernel().at({0, 0, 1}, {1, 1}), batch.u1, batch.u2, batch.wm()),
        message);
  }
}
