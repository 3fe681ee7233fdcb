// All cases: the baseline, the reference samplers, the paper's layout read literally, the plain
// tables by size, and kernels by tolerance.
#pragma once

#include <string>
#include <vector>

#include "vndf/bench/case.h"

namespace vndf::bench {

/// Specifications that run where none are named (precompute/distribution_spec.h).
inline const std::vector<std::string> kUsualDistributions{"beckmann", "ggx", "student-t:gamma=4",
                                                          "exponential-power:p=0.5"};

struct CaseOptions {
  std::vector<std::string> distributions = kUsualDistributions;
  /// Rows and columns of tables, each read literally and with linear rows.
  std::vector<std::size_t> sides = {64, 256, 1024};
  /// Tolerances that kernels are baked for from pairs of 1024 x 1024, each as fast and as small as
  /// they come, prepared and batched.
  std::vector<double> tolerances = {1e-4, 1e-5};
  /// Files of pairs or of baked tables, each a distribution of its own, beside those that are
  /// named.
  std::vector<std::string> files = {};
};

/// The baseline first, then those of each distribution by kind. Tables that they share live until
/// the last of the cases is gone. Throws std::invalid_argument for a distribution that is none, and
/// what the readers throw for a file.
std::vector<Case> all_cases(const CaseOptions& options);

/// The baseline and those in whose names one of `words` occurs, or all where there are no words.
/// Throws std::invalid_argument for a word that occurs in none.
std::vector<Case> chosen(std::vector<Case> all, const std::vector<std::string>& words);

}  // namespace vndf::bench
