// Who runs: the baseline, the reference samplers, the paper's layout read literally, and tables by
// size.
#pragma once

#include <string>
#include <vector>

#include "bench/contestant.h"

namespace vndf::bench {

/// Specifications that run where none are named (precompute/distribution_spec.h).
inline const std::vector<std::string> kUsualDistributions{"beckmann", "ggx", "student-t:gamma=4",
                                                          "exponential-power:p=0.5"};

struct FieldOptions {
  std::vector<std::string> distributions = kUsualDistributions;
  /// Rows and columns of tables, ours and read literally.
  std::vector<std::size_t> sides = {16, 32, 64, 128, 256, 512, 1024};
};

/// All of them, the baseline first. Throws std::invalid_argument for a distribution that is none.
std::vector<Entrant> entrants(const FieldOptions& options);

/// The baseline and those in whose names one of `words` occurs, or all where there are no words.
/// Throws std::invalid_argument for a word that occurs in none.
std::vector<Entrant> chosen(std::vector<Entrant> all, const std::vector<std::string>& words);

}  // namespace vndf::bench
