// Batches: sample by sample what the scalar sampler draws, on every target, for tables of every
// kind, at any length.
#include "batch/sample_batch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "batch_judge.h"
#include "batch_tables.h"
#include "catch.h"
#include "io/table_file.h"
#include "random_inputs.h"

using namespace vndf;
using namespace vndf::test;

namespace {

/// Five roundings: of the three squares, their inverse root and the products with it.
constexpr double kLengthError = 5 * 0x1p-24;

double length_error(const Vec3<float>& m) {
  return std::abs(std::hypot(double{m.x}, double{m.y}, double{m.z}) - 1);
}

bool same(const Vec3<float>& a, const Vec3<float>& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z;
}

std::vector<SamplerInput> hard_inputs(std::size_t n) {
  RandomInputs random(11);
  std::vector<SamplerInput> inputs;
  for (std::size_t i = 0; i < n; ++i) {
    SamplerInput in = random.hard();
    // What both samplers see must be the same to the last bit.
    const Vec3<float> wi = BatchJudge::wi(in);
    const Alpha<float> alpha = BatchJudge::alpha(in);
    in.wi = {wi.x, wi.y, wi.z};
    in.alpha = {alpha.x, alpha.y};
    inputs.push_back(in);
  }
  return inputs;
}

double worst_excess(const BatchJudge& judge, const std::vector<SamplerInput>& inputs) {
  BatchArrays batch;
  for (const auto& in : inputs) batch.add(in);
  batch.sample(judge.sampler());
  double worst = -1;
  for (std::size_t i = 0; i < inputs.size(); ++i)
    worst = std::max(worst, judge.excess(batch.normal(i), inputs[i]));
  return worst;
}

}  // namespace

TEST_CASE(
    "a batch draws what the scalar sampler draws, on every target and for tables of any kind") {
  auto tables = all_kinds_of_tables();
  tables.push_back(io::load(VNDF_GOLDEN_FOLDER "/ggx-1.0.h5").tables);
  const auto inputs = hard_inputs(4000);
  for (const auto& t : tables) {
    const BatchJudge judge(t);
    for_each_target([&](const char* target) {
      CAPTURE(t->distribution, target);
      CHECK(worst_excess(judge, inputs) <= judge.allowed());
    });
  }
}

TEST_CASE("the judge of batches sees a change of the normal, of u1 and of u2 by 1e-5") {
  const BatchJudge judge(all_kinds_of_tables().front());
  const SamplerInput in{{0.6, 0, 0.8}, {0.5, 0.5}, 0.375, 0.625};
  const auto moved = [&](double u1, double u2) {
    return judge.scalar({in.wi, in.alpha, in.u1 + u1, in.u2 + u2});
  };
  CHECK(judge.excess(judge.scalar(in), in) <= 0);
  CHECK(judge.excess(moved(1e-5, 0), in) > judge.allowed());
  CHECK(judge.excess(moved(0, 1e-5), in) > judge.allowed());
  auto turned = judge.scalar(in);
  turned.y += 1e-5f;
  CHECK(judge.excess(turned, in) > judge.allowed());
}

TEST_CASE("inputs at and outside the ends of their ranges give what the scalar sampler gives") {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInfinity = INFINITY;
  constexpr float kSmallest = std::numeric_limits<float>::denorm_min();
  const std::vector<Vec3<float>> directions{
      {0, 0, 1},      {1, 0, 0},         {0, -1, 0},        {0.6f, 0, 0.8f},
      {0, 1e-30f, 1}, {kSmallest, 0, 1}, {0.6f, 0, -0.8f},  {kNan, 0, 1},
      {0, kNan, 1},   {0, 0, kNan},      {kInfinity, 0, 1}, {0, -kInfinity, 0}};
  const std::vector<Alpha<float>> alphas{{0.5f, 0.5f}, {10, 1e-4f},    {1e-4f, 1},
                                         {0, 1},       {1, -1},        {kNan, 1},
                                         {1, kNan},    {kInfinity, 1}, {1, kInfinity}};
  const std::vector<float> us{0, kSmallest, 0.5f, 1 - 0x1p-24f, 1, -1, 2, kNan, kInfinity};
  for (const auto& t : all_kinds_of_tables()) {
    const BatchJudge judge(t);
    BatchArrays batch;
    for (const auto& wi : directions)
      for (const auto& alpha : alphas)
        for (const float u1 : us)
          for (const float u2 : us) batch.add(wi, alpha, u1, u2);
    for_each_target([&](const char* target) {
      batch.sample(judge.sampler());
      double worst = -1, worst_length = 0;
      for (std::size_t i = 0; i < batch.size(); ++i) {
        worst_length = std::max(worst_length, length_error(batch.normal(i)));
        const Alpha<float> alpha{batch.alpha_x[i], batch.alpha_y[i]};
        const Vec3<float> wi{batch.wi_x[i], batch.wi_y[i], batch.wi_z[i]};
        if (!valid(wi, alpha)) REQUIRE(same(batch.normal(i), {0, 0, 1}));
        if (valid(wi, alpha))
          worst = std::max(
              worst,
              judge.excess(batch.normal(i),
                           {{wi.x, wi.y, wi.z}, {alpha.x, alpha.y}, batch.u1[i], batch.u2[i]}));
      }
      CAPTURE(t->distribution, target);
      CHECK(worst <= judge.allowed());
      CHECK(worst_length <= kLengthError);
    });
  }
}

TEST_CASE("a sample does not depend on its place in a batch or on the length of the batch") {
  const BatchJudge judge(all_kinds_of_tables().front());
  const auto inputs = hard_inputs(200);
  for_each_target([&](const char* target) {
    CAPTURE(target);
    BatchArrays whole;
    for (const auto& in : inputs) whole.add(in);
    whole.sample(judge.sampler());
    for (std::size_t n = 0; n <= inputs.size(); ++n) {
      BatchArrays end;
      for (std::size_t i = inputs.size() - n; i < inputs.size(); ++i) end.add(inputs[i]);
      end.sample(judge.sampler());
      for (std::size_t i = 0; i < n; ++i)
        REQUIRE(same(end.normal(i), whole.normal(inputs.size() - n + i)));
    }
  });
}

TEST_CASE("several samples of a direction are those of the direction repeated") {
  const auto inputs = hard_inputs(150);
  for (const auto& t : all_kinds_of_tables()) {
    const TabulatedSampler<float> sampler(t);
    for_each_target([&](const char* target) {
      for (const std::size_t each : {1, 2, 3, 16, 17, 64, 100}) {
        CAPTURE(t->distribution, target, each);
        RandomInputs random(5);
        BatchArrays repeated, compact;
        for (const auto& in : inputs) {
          const auto wi = BatchJudge::wi(in);
          const auto alpha = BatchJudge::alpha(in);
          for (std::size_t k = 0; k < each; ++k) {
            const auto u1 = static_cast<float>(random.uniform());
            const auto u2 = static_cast<float>(random.uniform());
            repeated.add(wi, alpha, u1, u2);
            if (k == 0)
              compact.add(wi, alpha, u1, u2);
            else
              compact.add(u1, u2);
          }
        }
        repeated.sample(sampler);
        compact.sample(sampler, each);
        CHECK(compact.x == repeated.x);
        CHECK(compact.y == repeated.y);
        CHECK(compact.z == repeated.z);
      }
    });
  }
}

TEST_CASE("one roughness for all is that roughness given for each") {
  const BatchJudge judge(all_kinds_of_tables().front());
  for_each_target([&](const char* target) {
    CAPTURE(target);
    BatchArrays each;
    for (auto in : hard_inputs(90)) {
      in.alpha = {0.25, 0.5};
      each.add(in);
    }
    BatchArrays all = each;
    each.sample(judge.sampler());
    sample_batch(judge.sampler(), all.wi(), Alpha<float>{0.25f, 0.5f}, all.u1, all.u2, all.wm());
    CHECK(all.x == each.x);
    CHECK(all.y == each.y);
    CHECK(all.z == each.z);
  });
}

TEST_CASE("a batch of one incident direction draws what its scalar sampler draws") {
  const auto inputs = hard_inputs(60);
  for (const auto& t : all_kinds_of_tables()) {
    const BatchJudge judge(t);
    for_each_target([&](const char* target) {
      CAPTURE(t->distribution, target);
      double worst = -1;
      for (const auto& of : inputs) {
        BatchArrays batch;
        for (const auto& in : inputs)
          batch.add(static_cast<float>(in.u1), static_cast<float>(in.u2));
        const IncidentSampler<float> incident(judge.sampler(), BatchJudge::wi(of),
                                              BatchJudge::alpha(of));
        sample_batch(incident, batch.u1, batch.u2, batch.wm());
        for (std::size_t i = 0; i < inputs.size(); ++i)
          worst = std::max(
              worst, judge.excess(batch.normal(i), {of.wi, of.alpha, inputs[i].u1, inputs[i].u2}));
      }
      CHECK(worst <= judge.allowed());
      BatchArrays none;
      none.add(0.5f, 0.5f);
      sample_batch(IncidentSampler<float>(judge.sampler(), {0, 0, -1}, {1, 1}), none.u1, none.u2,
                   none.wm());
      CHECK(same(none.normal(0), {0, 0, 1}));
    });
  }
}

TEST_CASE("spans that differ in size are refused by name") {
  const BatchJudge judge(all_kinds_of_tables().front());
  const std::vector<std::pair<const char*, std::vector<float> BatchArrays::*>> spans{
      {"wi.x", &BatchArrays::wi_x},       {"wi.y", &BatchArrays::wi_y},
      {"wi.z", &BatchArrays::wi_z},       {"alpha.x", &BatchArrays::alpha_x},
      {"alpha.y", &BatchArrays::alpha_y}, {"u1", &BatchArrays::u1},
      {"u2", &BatchArrays::u2},           {"wm.y", &BatchArrays::y},
      {"wm.z", &BatchArrays::z}};
  for (const auto& [name, member] : spans) {
    BatchArrays batch;
    for (const auto& in : hard_inputs(3)) batch.add(in);
    (batch.*member).pop_back();
    CHECK_THROWS_WITH(batch.sample(judge.sampler()), contains(std::string(name) + " has 2 values"));
  }
  BatchArrays batch;
  for (const auto& in : hard_inputs(3)) batch.add(in);
  CHECK_THROWS_WITH(batch.sample(judge.sampler(), 2), contains("not a multiple of the 2"));
  CHECK_THROWS_AS(batch.sample(judge.sampler(), 0), std::invalid_argument);
}
