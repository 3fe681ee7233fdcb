// Runs a benchmark and reports the size, the errors and the speed of each sampler. The figures
// belong together because they come from one run.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "vndf/bench/case.h"
#include "vndf/bench/collector.h"

namespace vndf::bench {

/// A time divided by that of the baseline.
struct Ratio {
  double of_medians = 1;
  /// Of the lowest times, which disturbances affect least.
  double of_lowest = 1;
  /// Median of the ratios within each round, whose two times were measured under the same
  /// conditions.
  double in_rounds = 1;
};

struct SpeedEntry {
  std::string name, distribution;
  Kind kind = Kind::table;
  std::size_t bytes = 0;
  double build_seconds = 0;
  Errors errors = {};
  Timing coherent = {}, incoherent = {};  ///< seconds per sample
  /// Times when each sample waits for the previous one, and when the caches are also polluted
  /// between samples, minus the time of an empty sampler. Empty for batches.
  std::optional<Timing> chain = {}, polluted = {};
  std::optional<Timing> setup = {};  ///< seconds from file to first sample
  /// The times above divided by those of the baseline.
  Ratio coherent_ratio = {}, incoherent_ratio = {};
  std::optional<Ratio> chain_ratio = {}, polluted_ratio = {};
  /// Whether no sampler of the same distribution has both a lower incoherent time and a lower
  /// u-error.
  bool on_front = false;
};

/// Where and how the run was made.
struct Environment {
  std::string program, processor, compiler, flags, date;
  std::size_t samples = 0;
  int repetitions = 0;
  /// Processor time of the run over its wall-clock time. The rest went to other programs.
  double processor_share = 1;
  /// Median over lowest time of the baseline. It is large if other programs slowed down memory,
  /// caches or the clock.
  double baseline_spread = 1;
};

/// On a quiet machine the processor share is at least this and the baseline spread at most this.
inline constexpr double kQuietShare = 0.95, kQuietSpread = 1.1;

/// Whether other programs used so much of the machine that the figures cannot be trusted.
bool busy(const Environment& environment);

struct SpeedReport {
  Environment environment;
  std::vector<SpeedEntry> entries;  ///< the baseline first
};

struct SpeedOptions {
  CollectOptions collect = {};
  /// Number of samples in the inputs; 0 means samples_beyond_caches().
  std::size_t samples = 0;
  /// Name and version of the program, for the report.
  std::string program = {};
};

/// Makes and times the cases, the first of which is the baseline of all ratios.
/// `options.collect.progress` is told about both. Throws std::invalid_argument if there is no case,
/// and what making a case and collect() throw.
SpeedReport measure_speed(const std::vector<Case>& cases, const SpeedOptions& options);

/// Sets the ratios of all entries to the first one, and marks the entries on the front of their
/// distribution. The baseline competes with the samplers of its own distribution.
void compare(std::vector<SpeedEntry>& entries);

/// Tables in Markdown, one for each distribution, after a line that warns if the machine was busy.
std::string describe(const SpeedReport& report);

/// The same as one object, in which null stands for a figure that has no meaning.
nlohmann::ordered_json to_json(const SpeedReport& report);

}  // namespace vndf::bench
