// Times pieces of work with Google Benchmark, all of them in one run whose repetitions are
// interleaved at random: what disturbs the machine for a while disturbs all alike, and ratios stay.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace vndf::bench {

struct Trial {
  /// What is timed; it is called again and again.
  std::function<void()> work;
  /// Samples that one call makes.
  std::size_t samples = 1;
};

struct CollectOptions {
  /// Repetitions of every trial, >= 1; their median counts.
  int repetitions = 7;
  /// Seconds that one repetition takes at least.
  double seconds = 0.05;
};

/// Seconds of processor time per sample.
struct Timing {
  double median = 0, lowest = 0, highest = 0;
};

/// The middle value, or the mean of the middle two. Throws std::invalid_argument where there is
/// none.
double median(std::vector<double> values);

/// Median, least and greatest. Throws as median() does.
Timing timing_of(const std::vector<double>& values);

/// A timing for each trial. Throws std::invalid_argument unless repetitions >= 1 and seconds > 0,
/// std::runtime_error if Google Benchmark does not report every repetition. What a trial throws is
/// passed on. Not for two threads at a time: Google Benchmark keeps its list in global variables.
std::vector<Timing> collect(const std::vector<Trial>& trials, const CollectOptions& options);

}  // namespace vndf::bench
