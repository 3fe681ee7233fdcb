// A panel first chooses what it shows and then places everything in pixels, because only then can
// labels be kept apart.
#include "vndf/bench/speed_panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "vndf/bench/pareto.h"

namespace vndf::bench {
namespace {

/// Half the width of a mark, and of a line, with some room around them.
constexpr double kMark = 5, kLine = 2;

constexpr int kLeastPower = -7, kMostPower = -1;

const char* colour_of_line(const SpeedEntry& e) {
  return e.kind == Kind::baseline ? "#b5367a" : "#777777";
}

double bytes_of(const SpeedEntry& e) {
  return static_cast<double>(e.bytes);
}

double ratio_of(const SpeedEntry& e) {
  return e.incoherent_ratio.of_medians;
}

/// At most six ticks at powers of four. There is none near the right end, where it would overlap
/// the key.
std::string ticks_of_bytes(double low, double high) {
  const double step = high / low > 4096 ? 16 : 4;
  std::string ticks;
  for (double size = 64; size < high / 1.5; size *= step) {
    const bool small = size < 1024, middle = size < 1 << 20;
    const char* unit = small ? "B" : middle ? "KiB" : "MiB";
    const double count = size / (small ? 1 : middle ? 1024 : 1 << 20);
    if (size > low)
      ticks += fmt::format("{}'{:.0f} {}' {:.0f}", ticks.empty() ? "" : ", ", count, unit, size);
  }
  return ticks;
}

/// The data and the series of one plot command.
struct Series {
  std::string data, plots;

  void add(const std::string& name, const std::string& rows, const std::string& style) {
    data += fmt::format("${} << EOD\n{}EOD\n", name, rows);
    plots += fmt::format("{}${} using 1:2 {} notitle", plots.empty() ? "" : ", ", name, style);
  }
};

std::string row_of(const SpeedEntry& e) {
  return fmt::format("{} {:.4f}\n", e.bytes, ratio_of(e));
}

}  // namespace

std::string Canvas::at(const Place& p) const {
  return fmt::format("screen {:.5f},{:.5f}", p.x / width, p.y / height);
}

std::string Canvas::label(const Place& p, const std::string& text, const char* side,
                          const char* colour) const {
  return fmt::format("set label '{}' at {} {} noenhanced font ',8' tc rgb '{}' front\n", text,
                     at(p), side, colour);
}

std::string Canvas::mark(const Place& p, int point, const char* colour) const {
  return fmt::format("set label '' at {} point pt {} ps 0.8 lc rgb '{}' front\n", at(p), point,
                     colour);
}

int power_of(const SpeedEntry& entry) {
  const double power = std::ceil(std::log10(std::max(*entry.errors.u, 1e-300)));
  return static_cast<int>(std::clamp<double>(power, kLeastPower, kMostPower));
}

const char* colour_of(int power) {
  static constexpr const char* kColours[] = {"#aaaaaa", "#d9a400", "#d1495b", "#8f3fa8",
                                             "#2b6cb0", "#1b998b", "#222222"};
  return kColours[kMostPower - power];
}

SpeedPanel::SpeedPanel(const SpeedReport& report, const std::string& distribution)
    : distribution_(distribution) {
  for (const SpeedEntry& e : report.entries) {
    const bool here = e.distribution == distribution && e.errors.u.has_value();
    if (e.kind == Kind::baseline || (here && e.bytes == 0)) lines_.push_back(&e);
    if (here && e.bytes > 0) marks_.push_back(&e);
  }
  std::ranges::stable_sort(marks_, {}, [](const SpeedEntry* e) { return e->bytes; });
  for (int power = kMostPower; power >= kLeastPower; --power) {
    Front front = front_of(power);
    // A front without an entry of this tolerance would repeat the next finer one.
    if (std::ranges::any_of(front.steps, [&](auto* e) { return power_of(*e) == power; }))
      fronts_.push_back(std::move(front));
  }
  std::vector<double> bytes;
  for (const SpeedEntry* e : marks_) bytes.push_back(bytes_of(*e));
  if (bytes.empty()) bytes.push_back(1024);
  bytes_ = axis_around(bytes, 2);
  time_ = axis_around(ratios_to_show(), 1.25);
}

double SpeedPanel::Axis::at(double value) const {
  return std::log(value / low) / std::log(high / low);
}

SpeedPanel::Axis SpeedPanel::axis_around(const std::vector<double>& values, double room) {
  const auto [low, high] = std::ranges::minmax(values);
  return {low / room, high * room};
}

/// The ratios of the marks and of the baseline. A distant line is left out because it would leave
/// little room for the marks.
std::vector<double> SpeedPanel::ratios_to_show() const {
  std::vector<double> ratios{1};
  for (const SpeedEntry* e : marks_.empty() ? lines_ : marks_) ratios.push_back(ratio_of(*e));
  return ratios;
}

SpeedPanel::Front SpeedPanel::front_of(int power) const {
  Entries keep;
  std::vector<Costs> costs;
  for (const SpeedEntry* e : marks_)
    if (power_of(*e) <= power) {
      keep.push_back(e);
      costs.push_back({bytes_of(*e), ratio_of(*e)});
    }
  Front front{power, {}};
  for (const std::size_t k : pareto_front(costs)) front.steps.push_back(keep[k]);
  return front;
}

bool SpeedPanel::on_front(const SpeedEntry& entry) const {
  return std::ranges::any_of(fronts_, [&](const Front& front) {
    return std::ranges::find(front.steps, &entry) != front.steps.end();
  });
}

std::string SpeedPanel::short_name(const SpeedEntry& entry) const {
  const bool within = entry.kind != Kind::baseline && entry.name.starts_with(distribution_ + " ");
  return within ? entry.name.substr(distribution_.size() + 1) : entry.name;
}

std::vector<SpeedPanel::KeyRow> SpeedPanel::key() const {
  std::vector<KeyRow> rows;
  for (std::size_t k = 0; k < marks_.size(); ++k)
    rows.push_back(
        {fmt::format("{:2}  {}", k + 1, short_name(*marks_[k])), colour_of(power_of(*marks_[k]))});
  for (const SpeedEntry* e : lines_)
    rows.push_back(
        {fmt::format("--  {}: {:.2f}", short_name(*e), ratio_of(*e)), colour_of_line(*e)});
  return rows;
}

/// Makes the script of a panel, given the place of its plot on the canvas.
struct SpeedPanel::Drawing {
  const SpeedPanel& panel;
  const Canvas& canvas;
  Box plot;
  LabelPlaces places;

  Drawing(const SpeedPanel& drawn, const Canvas& on, const Box& in)
      : panel(drawn), canvas(on), plot(in), places(in) {
    for (const SpeedEntry* e : panel.marks_)
      places.take(box_around(place(*e), 2 * kMark, 2 * kMark));
    for (const SpeedEntry* e : panel.lines_) take_line(plot.left, plot.right, level(*e));
    for (const Front& front : panel.fronts_) take_steps(front);
  }

  double level(const SpeedEntry& e) const {
    return plot.bottom + (plot.top - plot.bottom) * panel.time_.at(ratio_of(e));
  }
  Place place(const SpeedEntry& e) const {
    return {plot.left + (plot.right - plot.left) * panel.bytes_.at(bytes_of(e)), level(e)};
  }

  void take_line(double from, double to, double y) {
    places.take({from, y - kLine, to, y + kLine});
  }
  void take_steps(const Front& front) {
    for (std::size_t k = 0; k < front.steps.size(); ++k) {
      const bool last = k + 1 == front.steps.size();
      const Place here = place(*front.steps[k]);
      const Place next = last ? Place{plot.right, here.y} : place(*front.steps[k + 1]);
      take_line(here.x, next.x, here.y);
      places.take({next.x - kLine, next.y, next.x + kLine, here.y});
    }
  }

  std::string frame() const {
    const Axis &x = panel.bytes_, &y = panel.time_;
    return fmt::format(
        "set title '{}' noenhanced\nset lmargin at screen {:.5f}\nset rmargin at screen {:.5f}\n"
        "set bmargin at screen {:.5f}\nset tmargin at screen {:.5f}\n"
        "set xrange [{:.6e}:{:.6e}]\nset yrange [{:.6e}:{:.6e}]\nset xtics ({})\n",
        panel.distribution_, plot.left / canvas.width, plot.right / canvas.width,
        plot.bottom / canvas.height, plot.top / canvas.height, x.low, x.high, y.low, y.high,
        ticks_of_bytes(x.low, x.high));
  }

  /// The lines of entries without tables, with their names at the right edge.
  std::string lines() {
    std::string text;
    for (const SpeedEntry* e : panel.lines_) {
      if (ratio_of(*e) < panel.time_.low || ratio_of(*e) > panel.time_.high) continue;
      text += fmt::format(
          "set arrow from graph 0, first {0:.4f} to graph 1, first {0:.4f} nohead dt 2 lc rgb "
          "'{1}'\n",
          ratio_of(*e), colour_of_line(*e));
      text += line_name(*e);
    }
    return text;
  }
  std::string line_name(const SpeedEntry& e) {
    const std::string name = panel.short_name(e);
    const double width = kCharacterWidth * static_cast<double>(name.size());
    std::vector<Place> candidates;
    for (double shift = 4; shift < (plot.right - plot.left) / 2; shift += 20)
      for (const int side : {1, -1})
        candidates.push_back(
            {plot.right - shift - width / 2, level(e) + side * (kLine + kCharacterHeight / 2)});
    const auto p = places.put(candidates, width, kCharacterHeight);
    return p ? canvas.label({p->x + width / 2, p->y}, name, "right", colour_of_line(e)) : "";
  }

  /// The numbers of the marks. Those on a front come first, because there may not be room for all.
  std::string numbers() {
    std::string text;
    for (const bool front : {true, false})
      for (std::size_t k = 0; k < panel.marks_.size(); ++k)
        if (panel.on_front(*panel.marks_[k]) == front) text += number(k);
    return text;
  }
  std::string number(std::size_t k) {
    const SpeedEntry& e = *panel.marks_[k];
    const std::string name = std::to_string(k + 1);
    const double width = kCharacterWidth * static_cast<double>(name.size());
    const auto p = places.put_beside(place(e), kMark, width, kCharacterHeight);
    return p ? canvas.label(*p, name, "center", colour_of(power_of(e))) : "";
  }

  std::string key(double gap) const {
    std::string text;
    Place p{plot.right + gap, plot.top - kCharacterHeight / 2};
    for (const auto& [row, colour] : panel.key()) {
      text += canvas.label(p, row, "left", colour);
      p.y -= kCharacterHeight;
    }
    return text;
  }

  /// The steps of a front, up to the right edge of the plot.
  std::string steps(const Front& front) const {
    std::string rows;
    for (const SpeedEntry* e : front.steps) rows += row_of(*e);
    return rows + fmt::format("{:.0f} {:.4f}\n", panel.bytes_.high, ratio_of(*front.steps.back()));
  }

  /// All series with entries, because gnuplot cannot draw an empty one.
  Series series() const {
    Series series;
    for (const Front& front : panel.fronts_)
      series.add(fmt::format("front{}", -front.power), steps(front),
                 fmt::format("with steps lw 2 lc rgb '{}'", colour_of(front.power)));
    for (const Look& look : kLooks)
      for (int power = kMostPower; power >= kLeastPower; --power) add_marks(series, look, power);
    if (series.plots.empty()) series.plots = "NaN notitle";
    return series;
  }
  void add_marks(Series& series, const Look& look, int power) const {
    std::string rows;
    for (const SpeedEntry* e : panel.marks_)
      if (e->kind == look.kind && power_of(*e) == power) rows += row_of(*e);
    if (rows.empty()) return;
    series.add(fmt::format("{}{}", name_of(look.kind), -power), rows,
               fmt::format("with points pt {} ps 0.8 lc rgb '{}'", look.point, colour_of(power)));
  }
};

std::string SpeedPanel::script(const Canvas& canvas, const Box& plot, double gap) const {
  Drawing drawing(*this, canvas, plot);
  const Series series = drawing.series();
  std::string text = series.data + drawing.frame();
  text += drawing.lines();
  text += drawing.numbers();
  text += drawing.key(gap);
  return text + "plot " + series.plots + "\nunset label\nunset arrow\n";
}

}  // namespace vndf::bench
