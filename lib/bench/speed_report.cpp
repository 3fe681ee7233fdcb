// Running the benchmark and showing what came of it.
#include "bench/speed_report.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>
#include <fstream>
#include <map>
#include <memory>
#include <stdexcept>

#include "bench/pareto.h"
#include "bench/sample_inputs.h"

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

Circumstances circumstances(const SpeedOptions& options, std::size_t samples) {
  return {options.program,
          processor(),
          kCompiler,
          VNDF_BENCH_FLAGS,
          fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr))),
          samples,
          options.collect.repetitions};
}

/// The trials of contestant `c`: coherent, incoherent and, if it has files, setup.
void add_trials(std::vector<Trial>& trials, const Contestant& c,
                const std::shared_ptr<SampleInputs>& inputs) {
  const auto coherent = [&run = c.coherent, inputs] {
    run(kCoherentWi, kCoherentAlpha, inputs->next());
  };
  const auto incoherent = [&run = c.incoherent, inputs] { run(inputs->next()); };
  trials.push_back({coherent, SampleInputs::kBlock});
  trials.push_back({incoherent, SampleInputs::kBlock});
  if (c.setup) trials.push_back({c.setup});
}

std::vector<SpeedEntry> entries_of(const std::vector<Entrant>& entrants,
                                   const std::vector<Contestant>& contestants,
                                   const std::vector<Timing>& timings) {
  std::vector<SpeedEntry> entries;
  auto next = timings.begin();
  for (std::size_t k = 0; k < entrants.size(); ++k) {
    const Entrant& e = entrants[k];
    const Contestant& c = contestants[k];
    SpeedEntry entry{e.name, e.distribution, e.kind, e.side, c.bytes, c.build_seconds, c.errors};
    entry.coherent = *next++;
    entry.incoherent = *next++;
    if (c.setup) entry.setup = *next++;
    entries.push_back(entry);
  }
  return entries;
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

std::string row_of(const SpeedEntry& e) {
  const std::string setup = e.setup ? fmt::format("{:.2f}", e.setup->median * 1e3) : "-";
  const std::string build = e.build_seconds > 0 ? fmt::format("{:.2f}", e.build_seconds) : "-";
  return fmt::format("| {}{} | {} | {} | {} | {:.1f} | {:.1f} | {:.2f} | {:.2f} | {} | {} | {} |\n",
                     e.name, e.on_front ? " *" : "", size_of(e.bytes), build, setup,
                     e.coherent.median * 1e9, e.incoherent.median * 1e9, e.coherent_ratio,
                     e.incoherent_ratio, dash_or(e.errors.u, "{:.1e}"),
                     dash_or(e.errors.density, "{:.1e}"), dash_or(e.errors.tail_ratio, "{:.3g}"));
}

nlohmann::ordered_json number_or_null(const std::optional<double>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
}

/// Of seconds, in units of 1 / `scale` seconds.
nlohmann::ordered_json to_json(const Timing& t, double scale) {
  return {
      {"median", t.median * scale}, {"lowest", t.lowest * scale}, {"highest", t.highest * scale}};
}

nlohmann::ordered_json to_json(const SpeedEntry& e) {
  return {{"name", e.name},
          {"distribution", e.distribution},
          {"kind", name_of(e.kind)},
          {"bytes", e.bytes},
          {"build_seconds", e.build_seconds},
          {"coherent_ns", to_json(e.coherent, 1e9)},
          {"incoherent_ns", to_json(e.incoherent, 1e9)},
          {"coherent_ratio", e.coherent_ratio},
          {"incoherent_ratio", e.incoherent_ratio},
          {"setup_ms", e.setup ? to_json(*e.setup, 1e3) : nlohmann::ordered_json()},
          {"u_error", number_or_null(e.errors.u)},
          {"density_error", number_or_null(e.errors.density)},
          {"tail_ratio", number_or_null(e.errors.tail_ratio)},
          {"on_front", e.on_front}};
}

}  // namespace

SpeedReport measure_speed(const std::vector<Entrant>& entrants, const SpeedOptions& options) {
  if (entrants.empty()) throw std::invalid_argument("no sampler to time; give one or more");
  const auto tell = [&options](const std::string& what) {
    if (options.progress) options.progress(what);
  };
  std::vector<Contestant> contestants;
  for (const Entrant& e : entrants) {
    tell(fmt::format("making {} of {}: {}", contestants.size() + 1, entrants.size(), e.name));
    contestants.push_back(e.make());
  }
  const auto inputs = std::make_shared<SampleInputs>(options.samples > 0 ? options.samples
                                                                         : samples_beyond_caches());
  std::vector<Trial> trials;
  for (const Contestant& c : contestants) add_trials(trials, c, inputs);
  tell(fmt::format("timing {} samplers", entrants.size()));
  const std::vector<Timing> timings = collect(trials, options.collect);

  SpeedReport report{circumstances(options, inputs->size()),
                     entries_of(entrants, contestants, timings)};
  compare(report.entries);
  return report;
}

void compare(std::vector<SpeedEntry>& entries) {
  std::map<std::string, bool> seen;
  for (SpeedEntry& e : entries) {
    e.coherent_ratio = e.coherent.median / entries.front().coherent.median;
    e.incoherent_ratio = e.incoherent.median / entries.front().incoherent.median;
    e.on_front = false;
  }
  for (const SpeedEntry& e : entries)
    if (seen.emplace(e.distribution, true).second) mark_front(entries, e.distribution);
}

std::string describe(const SpeedReport& report) {
  const Circumstances& at = report.circumstances;
  std::string text = fmt::format(
      "{}, {}, {}, {}; {} samples, medians of {} repetitions.\n"
      "Nanoseconds of one thread per sample; ratios to {}, in the same run; * is on the front of\n"
      "incoherent speed and u-error.\n\n"
      "| sampler | bytes | build, s | setup, ms | coherent, ns | incoherent, ns | ratio, coherent "
      "| ratio, incoherent | u-error | density error | tail ratio |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|\n",
      at.processor, at.compiler, at.flags, at.date, at.samples, at.repetitions,
      report.entries.front().name);
  for (const SpeedEntry& e : report.entries) text += row_of(e);
  return text;
}

nlohmann::ordered_json to_json(const SpeedReport& report) {
  const Circumstances& at = report.circumstances;
  nlohmann::ordered_json entries = nlohmann::ordered_json::array();
  for (const SpeedEntry& e : report.entries) entries.push_back(to_json(e));
  return {{"program", at.program},
          {"processor", at.processor},
          {"compiler", at.compiler},
          {"flags", at.flags},
          {"date", at.date},
          {"samples", at.samples},
          {"repetitions", at.repetitions},
          {"baseline", report.entries.front().name},
          {"entries", entries}};
}

}  // namespace vndf::bench
