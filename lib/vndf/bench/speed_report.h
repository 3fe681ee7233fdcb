// The result of a benchmark: for each sampler its size, its errors and its speed, all of one run.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "vndf/bench/case.h"
#include "vndf/bench/collector.h"

namespace vndf::bench {

/// A time over that of the baseline.
struct Ratio {
  double of_medians = 1;
  /// Of the lowest times, which disturbances reach least.
  double of_lowest = 1;
  /// Median of the ratios within each round, whose two times met the same machine.
  double in_rounds = 1;
};

struct SpeedEntry {
  std::string name, distribution;
  Kind kind = Kind::table;
  std::size_t bytes = 0;
  double build_seconds = 0;
  Errors errors = {};
  Timing coherent = {}, incoherent = {};  ///< seconds per sample
  /// Each sample waiting for the one before; and with caches polluted between them, less what an
  /// empty sampler takes. None for batches.
  std::optional<Timing> chain = {}, polluted = {};
  std::optional<Timing> setup = {};  ///< seconds from file to first sample
  /// To the baseline.
  Ratio coherent_ratio = {}, incoherent_ratio = {};
  std::optional<Ratio> chain_ratio = {}, polluted_ratio = {};
  /// Whether no sampler of the same distribution is both faster (incoherent) and of less u-error.
  bool on_front = false;
};

/// Where and how the figures were taken.
struct Environment {
  std::string program, processor, compiler, flags, date;
  std::size_t samples = 0;
  int repetitions = 0;
  /// Processor time of the run over its wall-clock time: the rest went to others.
  double processor_share = 1;
  /// Median over lowest time of the baseline: others slow memory, caches and clock down as well.
  double baseline_spread = 1;
};

/// Figures of a quiet machine have at least this share and at most this spread.
inline constexpr double kQuietShare = 0.95, kQuietSpread = 1.1;

/// Whether the machine had so much else to do that the figures are not to be trusted.
bool busy(const Environment& environment);

struct SpeedReport {
  Environment environment;
  std::vector<SpeedEntry> entries;  ///< the baseline first
};

struct SpeedOptions {
  CollectOptions collect = {};
  /// Samples to walk through; 0 for samples_beyond_caches().
  std::size_t samples = 0;
  /// Name and version of the program, for the report.
  std::string program = {};
};

/// Makes and times the cases, the first of which is the baseline of the ratios; `options.collect`
/// is told the progress of both. Throws std::invalid_argument without any, and what making them and
/// collect() throw.
SpeedReport measure_speed(const std::vector<Case>& cases, const SpeedOptions& options);

/// Sets the ratios to the first entry and which entries are on the front of their distribution. The
/// baseline runs against the samplers of its own distribution like any other.
void compare(std::vector<SpeedEntry>& entries);

/// Tables for people, in Markdown: one for each distribution, after a line that says so if the
/// machine was busy.
std::string describe(const SpeedReport& report);

/// The same as one object; null stands for what has no meaning.
nlohmann::ordered_json to_json(const SpeedReport& report);

}  // namespace vndf::bench
