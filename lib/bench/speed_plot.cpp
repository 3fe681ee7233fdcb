// The script that draws speed against error.
#include "bench/speed_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace vndf::bench {
namespace {

/// One set of marks: which entries, and how they look.
struct Series {
  const char* title;
  const char* style;
  bool (*shows)(const SpeedEntry&);
};

bool is_table(const SpeedEntry& e, const char* rows) {
  return e.kind == Kind::table && e.name.find(rows) != std::string::npos;
}

const Series kSeries[] = {
    {"the paper read literally", "with linespoints pt 2 ps 0.7 lc rgb '#999999' dt 3",
     [](const SpeedEntry& e) { return e.kind == Kind::literal; }},
    {"tables, linear rows", "with linespoints pt 6 ps 0.7 lc rgb '#3b528b' dt 3",
     [](const SpeedEntry& e) { return is_table(e, " linear "); }},
    {"tables, cubic rows", "with linespoints pt 7 ps 0.7 lc rgb '#21918c' dt 3",
     [](const SpeedEntry& e) { return is_table(e, " cubic "); }},
    {"smallest tables for a tolerance", "with points pt 13 ps 1.2 lc rgb '#35b779'",
     [](const SpeedEntry& e) { return e.kind == Kind::compact; }},
    {"closed forms", "with points pt 9 ps 1 lc rgb '#b5367a'",
     [](const SpeedEntry& e) { return e.kind == Kind::reference || e.kind == Kind::baseline; }},
    {"Pareto front", "with steps lw 2 lc rgb '#000000'",
     [](const SpeedEntry& e) { return e.on_front; }},
};

/// Those of which more than the baseline is to be seen.
std::vector<std::string> distributions(const SpeedReport& report) {
  std::vector<std::string> list;
  for (const SpeedEntry& e : report.entries)
    if (e.kind != Kind::baseline && e.errors.u &&
        std::ranges::find(list, e.distribution) == list.end())
      list.push_back(e.distribution);
  return list;
}

/// What is written beside a mark: the size of a table, the name of another sampler; nothing beside
/// the smallest tables, whose error says which they are.
std::string label_of(const SpeedEntry& e) {
  if (e.kind == Kind::compact) return "";
  if (e.side > 0) return std::to_string(e.side);
  return e.name.substr(e.distribution.size() + 1);
}

/// The entries of one series, by increasing error.
std::vector<const SpeedEntry*> shown_in(const SpeedReport& report, const std::string& distribution,
                                        const Series& series) {
  std::vector<const SpeedEntry*> shown;
  for (const SpeedEntry& e : report.entries)
    if (e.distribution == distribution && e.errors.u && series.shows(e)) shown.push_back(&e);
  std::ranges::stable_sort(shown, {}, [](const SpeedEntry* e) { return *e->errors.u; });
  return shown;
}

/// Their u-errors, ratios and labels.
std::string block(const std::vector<const SpeedEntry*>& shown, const std::string& name) {
  std::string text = "$" + name + " << EOD\n";
  for (const SpeedEntry* e : shown)
    text += fmt::format("{:.6e} {:.4f} \"{}\"\n", *e->errors.u, e->incoherent_ratio, label_of(*e));
  return text + "EOD\n";
}

/// Series without entries are left out: gnuplot cannot draw none.
std::string panel(const SpeedReport& report, const std::string& distribution, std::size_t number) {
  // The baseline is of one distribution, its speed the unit of all.
  std::string blocks, plots = "1 with lines lc rgb '#b5367a' dt 2 notitle";
  for (std::size_t k = 0; k < std::size(kSeries); ++k) {
    const auto shown = shown_in(report, distribution, kSeries[k]);
    if (shown.empty()) continue;
    const std::string name = fmt::format("panel{}_{}", number, k);
    blocks += block(shown, name);
    plots += fmt::format(", ${} using 1:2 {} title '{}'", name, kSeries[k].style, kSeries[k].title);
    if (k + 1 < std::size(kSeries))
      plots +=
          fmt::format(", ${} using 1:2:3 with labels left offset 0.6,0.4 font ',8' notitle", name);
  }
  return fmt::format("{}set title '{}' noenhanced\nset key {}\nplot {}\n", blocks, distribution,
                     number == 0 ? "top right" : "off", plots);
}

/// The decades around all values that are shown.
struct Range {
  double low, high;
};

template <class Value>
Range range_of(const SpeedReport& report, Value value) {
  Range range{1e300, 0};
  for (const SpeedEntry& e : report.entries)
    if (e.errors.u) {
      range.low = std::min(range.low, value(e));
      range.high = std::max(range.high, value(e));
    }
  return range;
}

}  // namespace

std::string speed_plot(const SpeedReport& report, const std::string& terminal,
                       const std::string& output) {
  const auto names = distributions(report);
  if (names.empty()) throw std::invalid_argument("no sampler has a u-error to draw; time others");
  const Range error = range_of(report, [](const SpeedEntry& e) { return *e.errors.u; });
  const Range ratio = range_of(report, [](const SpeedEntry& e) { return e.incoherent_ratio; });
  const std::size_t columns = names.size() > 1 ? 2 : 1, rows = (names.size() + 1) / columns;
  const Circumstances& at = report.circumstances;
  std::string text = fmt::format(
      "set terminal {} size {},{} font ',11' background 'white'\nset output '{}'\n"
      "set encoding utf8\n"
      "set multiplot layout {},{} title 'Time per sample over that of {}, random directions and "
      "roughness ({}, {}, {})' noenhanced\n"
      "set logscale xy\nset format x '10^{{%T}}'\nset grid lc rgb '#dddddd'\nset tics nomirror\n"
      "set ytics (0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100)\n"
      "set xlabel 'u-error, max'\nset ylabel 'time'\nset xrange [{:.3e}:{:.3e}]\n"
      "set yrange [{:.3f}:{:.3f}]\n",
      terminal, 560 * columns, 430 * rows + 50, output, rows, columns, report.entries.front().name,
      at.processor, at.compiler, at.date, error.low / 2, error.high * 4, ratio.low / 1.3,
      ratio.high * 6);
  for (std::size_t k = 0; k < names.size(); ++k) text += panel(report, names[k], k);
  return text + "unset multiplot\n";
}

}  // namespace vndf::bench
