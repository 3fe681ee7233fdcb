// Runs the benchmark and writes its report.
#include "vndf/bench/speed_report.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <fstream>
#include <set>
#include <stdexcept>

#include "vndf/bench/pareto.h"
#include "vndf/bench/sample_inputs.h"

namespace vndf::bench {
namespace {

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown";
}

#ifdef __clang__
constexpr const char* kCompiler = "clang " __clang_version__;
#else
constexpr const char* kCompiler = "gcc " __VERSION__;
#endif

/// The timings of a case, in the order in which entries_of() expects them.
void add_trials(std::vector<Trial>& trials, const Runner& r, Pollution& pollution,
                SampleInputs& inputs) {
  const auto add = [&trials](auto run) { trials.push_back({run, SampleInputs::kBlock}); };
  add([&r, &inputs] { r.coherent(kCoherentWi, kCoherentAlpha, inputs.next()); });
  add([&r, &inputs] { r.incoherent(inputs.next()); });
  if (r.chained) add([&r, &inputs] { r.chained(inputs.next()); });
  if (r.polluted) {
    add([&r, &inputs, &pollution] { r.polluted(inputs.next(), pollution); });
    trials.back().overhead = [&inputs, &pollution, empty = scalar_runs<float>(EmptySampler())] {
      empty.polluted(inputs.next(), pollution);
    };
  }
  if (r.setup) trials.push_back({r.setup});
}

std::vector<SpeedEntry> entries_of(const std::vector<Case>& cases,
                                   const std::vector<Runner>& runners,
                                   const std::vector<Timing>& timings) {
  std::vector<SpeedEntry> entries;
  auto next = timings.begin();
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const Case& c = cases[k];
    const Runner& r = runners[k];
    SpeedEntry entry{c.name, c.distribution, c.kind, r.bytes, r.build_seconds, r.errors};
    entry.coherent = *next++;
    entry.incoherent = *next++;
    if (r.chained) entry.chain = *next++;
    if (r.polluted) entry.polluted = *next++;
    if (r.setup) entry.setup = *next++;
    entries.push_back(entry);
  }
  return entries;
}

double spread(const Timing& t) {
  return t.median / t.lowest;
}

Environment environment_of(const SpeedOptions& options, std::size_t samples, double share,
                           const SpeedEntry& baseline) {
  return {options.program,
          processor(),
          kCompiler,
          VNDF_BENCH_FLAGS,
          fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr))),
          samples,
          options.collect.repetitions,
          share,
          std::max(spread(baseline.coherent), spread(baseline.incoherent))};
}

std::vector<Runner> make_all(const std::vector<Case>& cases, const SpeedOptions& options) {
  std::vector<Runner> runners;
  for (const Case& c : cases) {
    if (options.collect.progress)
      options.collect.progress(
          fmt::format("making {} of {}: {}", runners.size() + 1, cases.size(), c.name));
    runners.push_back(c.make());
  }
  return runners;
}

Ratio ratio(const Timing& time, const Timing& baseline) {
  std::vector<double> rounds;
  for (std::size_t k = 0; k < time.rounds.size(); ++k)
    rounds.push_back(time.rounds[k] / baseline.rounds[k]);
  return {time.median / baseline.median, time.lowest / baseline.lowest, median(rounds)};
}

std::optional<Ratio> ratio(const std::optional<Timing>& time,
                           const std::optional<Timing>& baseline) {
  if (!time || !baseline) return {};
  return ratio(*time, *baseline);
}

void mark_front(std::vector<SpeedEntry>& entries, const std::string& distribution) {
  std::vector<SpeedEntry*> rivals;
  std::vector<Costs> costs;
  for (SpeedEntry& e : entries)
    if (e.distribution == distribution && e.errors.u) {
      rivals.push_back(&e);
      costs.push_back({e.incoherent.median, *e.errors.u});
    }
  for (const std::size_t k : pareto_front(costs)) rivals[k]->on_front = true;
}

std::string dash_or(const std::optional<double>& value, fmt::format_string<const double&> format) {
  return value ? fmt::format(format, *value) : "-";
}

std::string size_of(std::size_t bytes) {
  if (bytes == 0) return "-";
  const double kib = static_cast<double>(bytes) / 1024;
  return kib < 1024 ? fmt::format("{:.1f} KiB", kib) : fmt::format("{:.1f} MiB", kib / 1024);
}

/// Two cells: nanoseconds, and the ratios of medians and of lowest times.
std::string cells_of(const std::optional<Timing>& time, const std::optional<Ratio>& ratio) {
  if (!time || !ratio) return "- | -";
  return fmt::format("{:.1f} | {:.2f} / {:.2f}", time->median * 1e9, ratio->of_medians,
                     ratio->of_lowest);
}

constexpr const char* kHead =
    "\n| sampler | bytes | build, s | setup, ms | coherent, ns | ratio | incoherent, ns | ratio "
    "| chain, ns | ratio | polluted, ns | ratio | u-error | density error | tail ratio |\n"
    "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";

std::string row_of(const SpeedEntry& e) {
  const std::string setup = e.setup ? fmt::format("{:.2f}", e.setup->median * 1e3) : "-";
  const std::string build = e.build_seconds > 0 ? fmt::format("{:.2f}", e.build_seconds) : "-";
  return fmt::format("| {}{} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", e.name,
                     e.on_front ? " *" : "", size_of(e.bytes), build, setup,
                     cells_of(e.coherent, e.coherent_ratio),
                     cells_of(e.incoherent, e.incoherent_ratio), cells_of(e.chain, e.chain_ratio),
                     cells_of(e.polluted, e.polluted_ratio), dash_or(e.errors.u, "{:.1e}"),
                     dash_or(e.errors.density, "{:.1e}"), dash_or(e.errors.tail_ratio, "{:.3g}"));
}

std::string busy_line(const Environment& at) {
  if (!busy(at)) return "";
  return fmt::format(
      "The machine was busy, do not trust the figures: the run had {:.1f} % of a processor, and "
      "the baseline's median is {:.2f} times its lowest time.\n",
      at.processor_share * 100, at.baseline_spread);
}

nlohmann::ordered_json number_or_null(const std::optional<double>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
}

/// The seconds of `t` in units of 1 / `scale` seconds.
nlohmann::ordered_json to_json(const Timing& t, double scale) {
  return {
      {"median", t.median * scale}, {"lowest", t.lowest * scale}, {"highest", t.highest * scale}};
}

nlohmann::ordered_json to_json_or_null(const std::optional<Timing>& time, double scale) {
  return time ? to_json(*time, scale) : nlohmann::ordered_json();
}

nlohmann::ordered_json to_json_or_null(const std::optional<Ratio>& ratio) {
  return ratio ? nlohmann::ordered_json(ratio->of_medians) : nlohmann::ordered_json();
}

nlohmann::ordered_json to_json(const SpeedEntry& e) {
  return {{"name", e.name},
          {"distribution", e.distribution},
          {"kind", name_of(e.kind)},
          {"bytes", e.bytes},
          {"build_seconds", e.build_seconds},
          {"coherent_ns", to_json(e.coherent, 1e9)},
          {"incoherent_ns", to_json(e.incoherent, 1e9)},
          {"coherent_ratio", e.coherent_ratio.of_medians},
          {"incoherent_ratio", e.incoherent_ratio.of_medians},
          {"coherent_lowest_ratio", e.coherent_ratio.of_lowest},
          {"incoherent_lowest_ratio", e.incoherent_ratio.of_lowest},
          {"coherent_round_ratio", e.coherent_ratio.in_rounds},
          {"incoherent_round_ratio", e.incoherent_ratio.in_rounds},
          {"chain_ns", to_json_or_null(e.chain, 1e9)},
          {"chain_ratio", to_json_or_null(e.chain_ratio)},
          {"polluted_ns", to_json_or_null(e.polluted, 1e9)},
          {"polluted_ratio", to_json_or_null(e.polluted_ratio)},
          {"setup_ms", to_json_or_null(e.setup, 1e3)},
          {"u_error", number_or_null(e.errors.u)},
          {"density_error", number_or_null(e.errors.density)},
          {"tail_ratio", number_or_null(e.errors.tail_ratio)},
          {"on_front", e.on_front}};
}

}  // namespace

bool busy(const Environment& environment) {
  return environment.processor_share < kQuietShare || environment.baseline_spread > kQuietSpread;
}

SpeedReport measure_speed(const std::vector<Case>& cases, const SpeedOptions& options) {
  if (cases.empty()) throw std::invalid_argument("no sampler to time; give one or more");
  const std::vector<Runner> runners = make_all(cases, options);
  SampleInputs inputs(options.samples > 0 ? options.samples : samples_beyond_caches());
  Pollution pollution;
  std::vector<Trial> trials;
  for (const Runner& r : runners) add_trials(trials, r, pollution, inputs);
  const Collection collected = collect(trials, options.collect);

  SpeedReport report{{}, entries_of(cases, runners, collected.timings)};
  compare(report.entries);
  report.environment =
      environment_of(options, inputs.size(), collected.processor_share, report.entries.front());
  return report;
}

void compare(std::vector<SpeedEntry>& entries) {
  const SpeedEntry& baseline = entries.front();
  std::set<std::string> distributions;
  for (SpeedEntry& e : entries) {
    e.coherent_ratio = ratio(e.coherent, baseline.coherent);
    e.incoherent_ratio = ratio(e.incoherent, baseline.incoherent);
    e.chain_ratio = ratio(e.chain, baseline.chain);
    e.polluted_ratio = ratio(e.polluted, baseline.polluted);
    e.on_front = false;
    distributions.insert(e.distribution);
  }
  for (const std::string& distribution : distributions) mark_front(entries, distribution);
}

std::string describe(const SpeedReport& report) {
  const Environment& at = report.environment;
  std::string text = fmt::format(
      "{}, {}, {}, {}; {} samples, {} repetitions.\n"
      "{}Medians of nanoseconds of one thread per sample; ratios, of medians / of lowest times, "
      "to\n"
      "{}, in the same run. In a chain each sample waits for the one before; polluted:\n"
      "the same, {} cache lines of {} MiB being read between samples, less what that takes by\n"
      "itself. * is on the front of incoherent speed and u-error.\n",
      at.processor, at.compiler, at.flags, at.date, at.samples, at.repetitions, busy_line(at),
      report.entries.front().name, Pollution::kLinesPerSample, Pollution::kBytes >> 20);
  std::string group;
  for (const SpeedEntry& e : report.entries) {
    if (e.distribution != group) text += kHead;
    group = e.distribution;
    text += row_of(e);
  }
  return text;
}

nlohmann::ordered_json to_json(const SpeedReport& report) {
  const Environment& at = report.environment;
  nlohmann::ordered_json entries = nlohmann::ordered_json::array();
  for (const SpeedEntry& e : report.entries) entries.push_back(to_json(e));
  return {{"program", at.program},
          {"processor", at.processor},
          {"compiler", at.compiler},
          {"flags", at.flags},
          {"date", at.date},
          {"samples", at.samples},
          {"repetitions", at.repetitions},
          {"busy", busy(at)},
          {"processor_share", at.processor_share},
          {"baseline_spread", at.baseline_spread},
          {"baseline", report.entries.front().name},
          {"entries", entries}};
}

}  // namespace vndf::bench
