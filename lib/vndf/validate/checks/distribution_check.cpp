// Distribution check, by counting.
#include "vndf/validate/checks/distribution_check.h"

#include <algorithm>
#include <mutex>

#include "vndf/validate/checks/configurations.h"
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

/// The counts at configuration `index` of `list`.
UniformCounts count(const SamplerUnderTest& sampler, const std::vector<Configuration>& list,
                    std::size_t index, const DistributionCheckOptions& options) {
  const Configuration& c = list[index];
  const ExactDistribution distribution(*sampler.exact, sampler.claims.normals, c);
  const BinCounts bins = bins_for(options.samples);
  UniformCounts all(bins);
  std::mutex mutex;  // guards `all`
  const std::uint64_t blocks = (options.samples + kBlock - 1) / kBlock;
  const auto workers = part_of(options.workers, index, list.size());
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

std::vector<CheckResult> check_distribution(const SamplerUnderTest& sampler,
                                            const DistributionCheckOptions& options) {
  std::vector<CheckResult> all;
  const auto list = check_configurations(sampler);
  for (std::size_t i = 0; i < list.size(); ++i) {
    const UniformCounts counts = count(sampler, list, i, options);
    const auto here =
        counts.results(sampler.bounds_at(list[i]).declared, "distribution", place_of(list[i]));
    merge_results(all, here);
    // Every configuration has the same tests, so the bound is known from the first on.
    bound_probabilities(all, options.significance, list.size() * number_of_tests(here));
    if (options.stop_at_first_failure && !all_passed(all)) break;
  }
  return all;
}

}  // namespace vndf::validate
