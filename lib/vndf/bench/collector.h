// Times pieces of work in rounds, each of which times every piece once in a random order. A
// disturbance of the machine then affects all pieces alike, and the ratios within one round compare
// times of the same minute.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace vndf::bench {

/// A piece of work to time.
struct Trial {
  /// The work, which is called repeatedly.
  std::function<void()> work;
  /// Samples that one call makes.
  std::size_t samples = 1;
  /// Work that `work` also contains but that does not count: it runs after each call, and its time
  /// is subtracted. May be empty.
  std::function<void()> overhead = {};
};

struct CollectOptions {
  /// Number of rounds, which is the number of repetitions of every trial. Valid: >= 1.
  int repetitions = 7;
  /// Seconds that a trial takes in one round, in which it is called at least once. Valid: > 0.
  double seconds = 0.05;
  /// Called with a description of each step before the step. May be empty.
  std::function<void(const std::string& what)> progress = {};
};

/// Seconds of processor time per sample.
struct Timing {
  double median = 0, lowest = 0, highest = 0;
  std::vector<double> rounds = {};  ///< in the order of the rounds
};

struct Collection {
  std::vector<Timing> timings;  ///< one for each trial
  /// Processor time of the timed calls over their wall-clock time. It is below 1 if other programs
  /// had the processor in between.
  double processor_share = 1;
};

/// The middle value, or the mean of the middle two. Throws std::invalid_argument if there is no
/// value.
double median(std::vector<double> values);

/// Median, lowest and highest of the times of all rounds. Throws what median() throws.
Timing timing_of(const std::vector<double>& rounds);

/// Times all trials. Throws std::invalid_argument unless repetitions >= 1 and seconds > 0; what a
/// trial throws is passed on.
Collection collect(const std::vector<Trial>& trials, const CollectOptions& options);

}  // namespace vndf::bench
