// The result of a benchmark: for each sampler its size, its errors and its speed, all of one run.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bench/collector.h"
#include "bench/contestant.h"

namespace vndf::bench {

struct SpeedEntry {
  std::string name, distribution;
  Kind kind = Kind::table;
  std::size_t side = 0;  ///< rows and columns of a table whose size was asked for
  std::size_t bytes = 0;
  double build_seconds = 0;
  Errors errors = {};
  Timing coherent = {}, incoherent = {};            ///< seconds per sample
  std::optional<Timing> setup = {};                 ///< seconds from file to first sample
  double coherent_ratio = 1, incoherent_ratio = 1;  ///< to the baseline, medians
  /// Whether no sampler of the same distribution is both faster (incoherent) and of less u-error.
  bool on_front = false;
};

/// Where and how the figures were taken.
struct Circumstances {
  std::string program, processor, compiler, flags, date;
  std::size_t samples = 0;
  int repetitions = 0;
};

struct SpeedReport {
  Circumstances circumstances;
  std::vector<SpeedEntry> entries;  ///< the baseline first
};

struct SpeedOptions {
  CollectOptions collect = {};
  /// Samples to walk through; 0 for samples_beyond_caches().
  std::size_t samples = 0;
  /// Name and version of the program, for the report.
  std::string program = {};
  /// Told what is being done, before it is; may be empty.
  std::function<void(const std::string& what)> progress = {};
};

/// Makes and times the entrants, the first of which is the baseline of the ratios. Throws
/// std::invalid_argument without any, and what making them and collect() throw.
SpeedReport measure_speed(const std::vector<Entrant>& entrants, const SpeedOptions& options);

/// Sets the ratios to the first entry and which entries are on the front of their distribution. The
/// baseline runs against the samplers of its own distribution like any other.
void compare(std::vector<SpeedEntry>& entries);

/// A table for people, in Markdown.
std::string describe(const SpeedReport& report);

/// The same as one object; null stands for what has no meaning.
nlohmann::ordered_json to_json(const SpeedReport& report);

}  // namespace vndf::bench
