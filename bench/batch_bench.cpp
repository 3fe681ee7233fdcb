// Time of a sample in batches, beside spherical caps: vndf_batch_bench FILE... measures the table
// files given, all in one run, on every target of the processor or with --best on the best alone.
// Of several rounds, in which all samplers take turns, the fastest counts: what disturbs a round
// only adds to it. The share of caps, not the nanoseconds, is what carries over to other machines.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <hwy/highway.h>

#include "batch/sample_batch.h"
#include "caps_batch.h"
#include "io/table_file.h"
#include "vndf/reference/ggx_caps.h"

namespace {

using namespace vndf;

constexpr std::size_t kSamples = 1 << 14, kPerDirection = 16;
constexpr int kRounds = 60;

struct Workload {
  std::vector<float> wi_x, wi_y, wi_z, alpha_x, alpha_y, u1, u2;
  std::vector<float> wm_x = std::vector<float>(kSamples), wm_y = wm_x, wm_z = wm_x;

  Workload() {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> uniform;
    for (std::size_t i = 0; i < kSamples; ++i) {
      const float z = uniform(random), phi = 2 * std::numbers::pi_v<float> * uniform(random);
      const float s = std::sqrt(1 - z * z);
      wi_x.push_back(s * std::cos(phi));
      wi_y.push_back(s * std::sin(phi));
      wi_z.push_back(z);
      alpha_x.push_back(0.05f + 0.95f * uniform(random));
      alpha_y.push_back(0.05f + 0.95f * uniform(random));
      u1.push_back(uniform(random));
      u2.push_back(uniform(random));
    }
  }

  DirectionSpans wi() const { return {wi_x, wi_y, wi_z}; }
  AlphaSpans alpha() const { return {alpha_x, alpha_y}; }
  NormalSpans wm() { return {wm_x, wm_y, wm_z}; }
  Vec3<float> wi(std::size_t i) const { return {wi_x[i], wi_y[i], wi_z[i]}; }
  Alpha<float> alpha(std::size_t i) const { return {alpha_x[i], alpha_y[i]}; }
  void set(std::size_t i, const Vec3<float>& m) {
    wm_x[i] = m.x;
    wm_y[i] = m.y;
    wm_z[i] = m.z;
  }
};

struct Timed {
  std::string name;
  std::function<void()> work;
  double nanoseconds = std::numeric_limits<double>::infinity();

  void round() {
    const auto begin = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - begin;
    nanoseconds = std::min(nanoseconds, time.count() / kSamples);
  }
};

void scalar(Workload& w, const auto& sampler) {
  for (std::size_t i = 0; i < kSamples; ++i)
    w.set(i, sampler.sample(w.wi(i), w.alpha(i), w.u1[i], w.u2[i]));
}

/// The first directions, each for `per_direction` samples.
void by_direction(Workload& w, const TabulatedSampler<float>& sampler, std::size_t per_direction) {
  const std::size_t n = kSamples / per_direction;
  const auto first = [n](const std::vector<float>& v) { return std::span(v).first(n); };
  sample_batch(sampler, {first(w.wi_x), first(w.wi_y), first(w.wi_z)},
               AlphaSpans{first(w.alpha_x), first(w.alpha_y)}, w.u1, w.u2, w.wm(), per_direction);
}

void scalar_by_direction(Workload& w, const TabulatedSampler<float>& sampler) {
  for (std::size_t begin = 0; begin < kSamples; begin += kPerDirection) {
    const IncidentSampler<float> incident(sampler, w.wi(begin), w.alpha(begin));
    for (std::size_t i = begin; i < begin + kPerDirection; ++i)
      w.set(i, incident.sample(w.u1[i], w.u2[i]));
  }
}

void add_tables(std::vector<Timed>& all, Workload& w, const TabulatedSampler<float>& sampler) {
  const SlopeTables& t = sampler.tables();
  const std::string name =
      t.distribution + ", " + std::to_string((sampling_bytes(t) + 512) / 1024) + " KiB: ";
  all.push_back({name + "scalar", [&] { scalar(w, sampler); }});
  all.push_back({name + "scalar, 16 a direction", [&] { scalar_by_direction(w, sampler); }});
  all.push_back(
      {name + "batch", [&] { sample_batch(sampler, w.wi(), w.alpha(), w.u1, w.u2, w.wm()); }});
  all.push_back({name + "batch, 16 a direction", [&] { by_direction(w, sampler, kPerDirection); }});
  all.push_back({name + "batch, one direction", [&] {
                   sample_batch(IncidentSampler<float>(sampler, w.wi(0), w.alpha(0)), w.u1, w.u2,
                                w.wm());
                 }});
}

void measure(const std::vector<TabulatedSampler<float>>& samplers) {
  Workload w;
  const GgxCaps<float> caps;
  std::vector<Timed> all;
  all.push_back({"caps: batch", [&] { bench::caps_batch(w.wi(), w.alpha(), w.u1, w.u2, w.wm()); }});
  all.push_back({"caps: batch, one direction",
                 [&] { bench::caps_batch(w.wi(0), w.alpha(0), w.u1, w.u2, w.wm()); }});
  all.push_back({"caps: scalar", [&] { scalar(w, caps); }});
  for (const auto& sampler : samplers) add_tables(all, w, sampler);
  for (int round = 0; round < kRounds; ++round)
    for (Timed& t : all) t.round();
  for (const Timed& t : all)
    std::printf("  %-60s %7.2f ns %6.2f caps\n", t.name.c_str(), t.nanoseconds,
                t.nanoseconds / all.front().nanoseconds);
}

}  // namespace

int main(int count, char** arguments) {
  bool best = false;
  std::vector<TabulatedSampler<float>> samplers;
  for (int i = 1; i < count; ++i) {
    if (arguments[i] == std::string("--best"))
      best = true;
    else
      samplers.emplace_back(io::load(arguments[i]).tables);
  }
  for (const auto target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(target);
    std::printf("%s\n", hwy::TargetName(target));
    measure(samplers);
    if (best) break;
  }
  hwy::SetSupportedTargetsForTest(0);
}
