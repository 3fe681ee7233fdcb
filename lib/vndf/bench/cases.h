// All cases of the benchmark: the baseline, the reference samplers, tables in the layout of the
// paper read literally, tables with linear rows by size, and kernels by tolerance.
#pragma once

#include <string>
#include <vector>

#include "vndf/bench/case.h"

namespace vndf::bench {

/// The distributions that run by default (distributions/parse_distribution.h).
inline const std::vector<std::string> kUsualDistributions{"beckmann", "ggx", "student-t:gamma=4",
                                                          "exponential-power:p=0.5"};

struct CaseOptions {
  std::vector<std::string> distributions = kUsualDistributions;
  /// Rows and columns of the tables, each of which runs read literally and with linear rows.
  std::vector<std::size_t> sides = {64, 256, 1024};
  /// Tolerances that kernels are baked for from pairs of 1024 x 1024. For each, the fastest and the
  /// smallest kernel run, and the fastest also prepared, batched and on surfaces with
  /// correlated slopes and a mean slope.
  std::vector<double> tolerances = {1e-4, 1e-5};
  /// Files of pairs or of baked tables, each of which counts as a further distribution.
  std::vector<std::string> files = {};
};

/// The baseline, then the cases of each distribution by kind. Tables that cases share exist until
/// the last of these cases is destroyed. Throws std::invalid_argument for an unknown distribution,
/// and what the readers throw for a file.
std::vector<Case> all_cases(const CaseOptions& options);

/// The baseline and the cases whose names contain one of `parts`, or all cases if `parts` is empty.
/// Throws std::invalid_argument for a part that no name contains.
std::vector<Case> chosen(std::vector<Case> all, const std::vector<std::string>& parts);

}  // namespace vndf::bench
