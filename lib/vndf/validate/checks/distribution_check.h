// Check: the distribution of sampled normals, by counting. Every normal is transformed to uniform
// numbers (exact_distribution.h), which are counted (uniformity.h). For every sampler, whatever its
// map.
#pragma once

#include <cstdint>
#include <vector>

#include "vndf/support/parallel.h"
#include "vndf/validate/sampler/sampler_under_test.h"
#include "vndf/validate/statistics/check_result.h"
#include "vndf/validate/statistics/significance.h"

namespace vndf::validate {

struct DistributionCheckOptions {
  /// Samples of each configuration. Beyond 1e8 the 24 bits of a single-precision random number
  /// above 1/2 move one sample in 3000 to the next of the 10007 bins, and count themselves.
  std::uint64_t samples = 2000000;
  /// Every random number follows from it, whatever the number of threads.
  std::uint64_t seed = 1;
  /// Probability that a correct sampler fails any of the tests; Sidak's correction is made here.
  double significance = kRunSignificance;
  /// Leave out the configurations after one that fails.
  bool stop_at_first_failure = false;
  support::Workers workers = {};
};

/// Configurations at which distributions are counted: pole to horizon, smooth to rough, anisotropy
/// to 1:500.
const std::vector<Configuration>& check_configurations();

/// p-values, the smallest over all configurations, with their bounds.
std::vector<CheckResult> check_distribution(const SamplerUnderTest& sampler,
                                            const DistributionCheckOptions& options);

}  // namespace vndf::validate
