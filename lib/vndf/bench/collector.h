// Times pieces of work in rounds: each round times every piece once, in an order of its own. What
// disturbs the machine for a while then disturbs all alike, and the ratios of one round compare
// times of the same minute.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace vndf::bench {

struct Trial {
  /// What is timed; it is called again and again.
  std::function<void()> work;
  /// Samples that one call makes.
  std::size_t samples = 1;
  /// Work of which as much is contained in `work`: it runs after each call, and its time is taken
  /// off. May be empty.
  std::function<void()> overhead = {};
};

struct CollectOptions {
  /// Rounds, >= 1: the repetitions of every trial.
  int repetitions = 7;
  /// Seconds that a trial takes in one round: its calls, at least one, are as many as fill them.
  double seconds = 0.05;
  /// Told what is being done, before it is; may be empty.
  std::function<void(const std::string& what)> progress = {};
};

/// Seconds of processor time per sample.
struct Timing {
  double median = 0, lowest = 0, highest = 0;
  std::vector<double> rounds = {};  ///< in the order of the rounds
};

struct Collection {
  std::vector<Timing> timings;  ///< one for each trial
  /// Processor time of the timed calls over their wall-clock time: below 1, others had the
  /// processor in between.
  double processor_share = 1;
};

/// The middle value, or the mean of the middle two. Throws std::invalid_argument where there is
/// none.
double median(std::vector<double> values);

/// Median, least and greatest of the figures of all rounds. Throws as median() does.
Timing timing_of(const std::vector<double>& rounds);

/// Times all trials. Throws std::invalid_argument unless repetitions >= 1 and seconds > 0; what a
/// trial throws is passed on.
Collection collect(const std::vector<Trial>& trials, const CollectOptions& options);

}  // namespace vndf::bench
