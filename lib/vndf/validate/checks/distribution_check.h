// Distribution check: whether sampled normals have the distribution that is claimed. Every normal
// is transformed to uniform numbers (exact_distribution.h), which are counted (uniformity.h). This
// needs no map, so it is made for every sampler.
#pragma once

#include <cstdint>
#include <vector>

#include "vndf/support/parallel.h"
#include "vndf/validate/sampler/sampler_under_test.h"
#include "vndf/validate/statistics/check_result.h"
#include "vndf/validate/statistics/significance.h"

namespace vndf::validate {

/// How much is counted, and when a count fails.
struct DistributionCheckOptions {
  /// Samples of each configuration. More than 1e8 are of no use: above 1/2 single-precision random
  /// numbers have 24 bits, which move one sample in 3000 to the next of the 10007 bins, and this
  /// would be counted as an error.
  std::uint64_t samples = 2000000;
  /// Every random number follows from it, whatever the number of threads.
  std::uint64_t seed = 1;
  /// Probability with which a correct sampler fails any of the tests. Sidak's correction for their
  /// number is made here.
  double significance = kRunSignificance;
  /// Whether configurations after one that fails are left out.
  bool stop_at_first_failure = false;
  support::Workers workers = {};
};

/// One result for each statistic of uniformity.h: its smallest p-value over all configurations of
/// check_configurations(), with the bound that follows from the significance.
std::vector<CheckResult> check_distribution(const SamplerUnderTest& sampler,
                                            const DistributionCheckOptions& options);

}  // namespace vndf::validate
