// Distribution check, by counting.
#include "vndf/validate/checks/distribution_check.h"

#include <algorithm>
#include <mutex>

#include "vndf/validate/statistics/block_random.h"

namespace vndf::validate {
namespace {

constexpr std::uint64_t kBlock = 1 << 15;
constexpr std::size_t kBatch = 1024;

void count_block(const SamplerUnderTest& sampler, const Configuration& c,
                 const ExactDistribution& distribution, BlockRandom random, std::uint64_t samples,
                 UniformCounts& counts) {
  std::vector<RandomPair> u(kBatch);
  std::vector<Vec3<double>> wm(kBatch);
  for (std::uint64_t done = 0; done < samples; done += kBatch) {
    const std::size_t size = std::min<std::uint64_t>(kBatch, samples - done);
    for (std::size_t k = 0; k < size; ++k) {
      const double u1 = random.single();
      u[k] = {u1, random.single()};
    }
    sampler.sample(c, {u.data(), size}, {wm.data(), size});
    for (std::size_t k = 0; k < size; ++k)
      counts.add(distribution.uniforms(wm[k], random.uniform()));
  }
}

UniformCounts count(const SamplerUnderTest& sampler, const Configuration& c, std::uint64_t index,
                    const DistributionCheckOptions& options) {
  const ExactDistribution distribution(*sampler.exact, sampler.claims.normals, c);
  const BinCounts bins = bins_for(options.samples);
  UniformCounts all(bins);
  std::mutex mutex;  // guards `all`
  const std::uint64_t blocks = (options.samples + kBlock - 1) / kBlock;
  const auto workers = part_of(options.workers, index, check_configurations().size());
  support::parallel_for(blocks, workers, [&](std::size_t block) {
    UniformCounts counts(bins);
    count_block(sampler, c, distribution, BlockRandom(options.seed, index, block),
                std::min(kBlock, options.samples - block * kBlock), counts);
    const std::lock_guard lock(mutex);
    all.add(counts);
  });
  return all;
}

}  // namespace

const std::vector<Configuration>& check_configurations() {
  static const std::vector<Configuration> list{at_angles(0, 0, 0.5, 0.5),
                                               at_angles(1e-3, 70, 1, 1),
                                               at_angles(0.25, 0, 1, 1),
                                               at_angles(10, 20, 0.1, 0.1),
                                               at_angles(30, 45, 2, 1),
                                               at_angles(45, 300, 0.001, 0.001),
                                               at_angles(50, 160, 0.01, 5),
                                               at_angles(60, 45, 2, 1),
                                               at_angles(75, 100, 0.3, 0.9),
                                               at_angles(80, 0, 10, 10),
                                               at_angles(85, 0, 1, 1),
                                               at_angles(89, 200, 0.2, 0.2),
                                               at_angles(89.9, 10, 1, 0.01),
                                               at_angles(89.999, 0, 0.5, 0.5),
                                               at_angles(90 - 1e-7, 120, 0.7, 2),
                                               at_angles(90, 30, 1, 1)};
  return list;
}

std::vector<CheckResult> check_distribution(const SamplerUnderTest& sampler,
                                            const DistributionCheckOptions& options) {
  std::vector<CheckResult> all;
  const auto& list = check_configurations();
  for (std::size_t i = 0; i < list.size(); ++i) {
    const UniformCounts counts = count(sampler, list[i], i, options);
    const auto here = counts.results(sampler.bounds.declared, "distribution", place_of(list[i]));
    merge_results(all, here);
    // Every configuration has the same tests, so the bound is known from the first on.
    bound_probabilities(all, options.significance, list.size() * number_of_tests(here));
    if (options.stop_at_first_failure && !all_passed(all)) break;
  }
  return all;
}

}  // namespace vndf::validate
