// The validator: all checks on one sampler. The checks without random numbers come first: they see
// errors of 1e-5, where counting a million samples sees those of 1e-2.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "vndf/support/parallel.h"
#include "vndf/validate/sampler/sampler_under_test.h"
#include "vndf/validate/statistics/check_result.h"
#include "vndf/validate/statistics/significance.h"

namespace vndf::validate {

enum class Thoroughness {
  quick,     ///< seconds
  standard,  ///< a minute on two cores
  thorough   ///< 1e9 samples
};

struct ValidationOptions {
  Thoroughness thoroughness = Thoroughness::standard;
  /// Of all random numbers of the distribution check.
  std::uint64_t seed = 1;
  /// Leave out the checks after one that fails.
  bool stop_at_first_failure = false;
  /// Samplers of the whole run, which share its significance.
  std::size_t samplers = 1;
  support::Workers workers = {};
};

struct Verdict {
  std::string sampler;
  std::vector<CheckResult> results;
  std::uint64_t samples = 0;  ///< that were counted, in all
  /// What the counted samples of one configuration can see: errors in u and of the mass of a bin.
  double visible_u_error = 0, visible_bin_error = 0;

  bool passed() const;
  /// The first result that did not pass, or null.
  const CheckResult* first_failure() const;
};

Verdict validate_sampler(const SamplerUnderTest& sampler, const ValidationOptions& options = {});

}  // namespace vndf::validate
