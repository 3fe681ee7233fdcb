// The judge: all stages on one subject. The stages without random numbers come first: they see
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

struct JudgeOptions {
  Thoroughness thoroughness = Thoroughness::standard;
  /// Of all random numbers of the law test.
  std::uint64_t seed = 1;
  /// Leave out the stages after one that fails.
  bool stop_at_first_failure = false;
  /// Subjects of the whole run, which share its significance.
  std::size_t subjects = 1;
  support::Workers workers = {};
};

struct Verdict {
  std::string subject;
  std::vector<Finding> findings;
  std::uint64_t samples = 0;  ///< that were counted, in all
  /// What the counted samples of one configuration can see: errors in u and of the mass of a bin.
  double visible_u_error = 0, visible_bin_error = 0;

  bool passed() const;
  /// The first finding that did not pass, or null.
  const Finding* first_failure() const;
};

Verdict judge(const Subject& subject, const JudgeOptions& options = {});

}  // namespace vndf::validate
