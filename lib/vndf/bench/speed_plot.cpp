// Arranges the panels in a grid, with a legend of their colours and marks below.
#include "vndf/bench/speed_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <set>
#include <stdexcept>
#include <vector>

#include "vndf/bench/speed_panel.h"

namespace vndf::bench {
namespace {

// Pixels around a plot, and of the whole.
constexpr double kLeft = 70, kGap = 12, kAbove = 40, kBelow = 60, kTitle = 60, kLegend = 40;
constexpr double kPlotWidth = 430, kPlotHeight = 330;

/// The point type of gnuplot that is a filled square.
constexpr int kSquare = 5;

/// The distributions that have an entry besides the baseline.
std::vector<std::string> distributions(const SpeedReport& report) {
  std::vector<std::string> list;
  for (const SpeedEntry& e : report.entries)
    if (e.kind != Kind::baseline && e.errors.u &&
        std::ranges::find(list, e.distribution) == list.end())
      list.push_back(e.distribution);
  return list;
}

/// One sign of the legend and its meaning. A point of type 0 is not drawn.
struct Sign {
  std::string text;
  int point;
  const char* colour;
};

/// The signs that occur in the panels.
std::vector<Sign> signs_of(const std::vector<SpeedPanel>& panels) {
  std::set<Kind> kinds;
  std::set<int, std::greater<>> powers;
  for (const SpeedPanel& panel : panels)
    for (const SpeedEntry* e : panel.marks()) {
      kinds.insert(e->kind);
      powers.insert(power_of(*e));
    }
  std::vector<Sign> signs;
  for (const Look& look : kLooks)
    if (kinds.contains(look.kind)) signs.push_back({look.title, look.point, "#000000"});
  if (!powers.empty()) signs.push_back({"Pareto fronts of u-errors up to", 0, "#000000"});
  for (const int power : powers)
    signs.push_back({fmt::format("1e{}", power), kSquare, colour_of(power)});
  return signs;
}

/// The signs in lines as wide as the canvas, from the top of the legend downwards.
std::string legend(const std::vector<Sign>& signs, const Canvas& canvas) {
  std::string text;
  Place p{kLeft, kLegend - kCharacterHeight};
  for (const Sign& s : signs) {
    const double width = kGap + kCharacterWidth * static_cast<double>(s.text.size());
    if (p.x + width > canvas.width) p = {kLeft, p.y - 1.5 * kCharacterHeight};
    if (s.point > 0) text += canvas.mark(p, s.point, s.colour);
    text += canvas.label({p.x + kGap, p.y}, s.text, "left", "#000000");
    p.x += width + kGap;
  }
  return text;
}

/// Places the panels in two columns, each with its key to the right.
class Grid {
 public:
  explicit Grid(const std::vector<SpeedPanel>& panels)
      : columns_(panels.size() > 1 ? 2 : 1), rows_((panels.size() + columns_ - 1) / columns_) {
    std::size_t longest = 0, most = 0;
    for (const SpeedPanel& panel : panels) {
      most = std::max(most, panel.key().size());
      for (const auto& row : panel.key()) longest = std::max(longest, row.text.size());
    }
    plot_height_ = std::max(kPlotHeight, kCharacterHeight * static_cast<double>(most));
    width_ = kLeft + kPlotWidth + kGap + kCharacterWidth * static_cast<double>(longest);
    height_ = kAbove + plot_height_ + kBelow;
  }

  Canvas canvas() const {
    return {width_ * static_cast<double>(columns_),
            height_ * static_cast<double>(rows_) + kTitle + kLegend};
  }
  /// Where the plot of panel k is, as high as the longest key.
  Box plot(std::size_t k) const {
    const auto column = static_cast<double>(k % columns_), row = static_cast<double>(k / columns_);
    const double left = column * width_ + kLeft;
    const double top = canvas().height - kTitle - row * height_ - kAbove;
    return {left, top - plot_height_, left + kPlotWidth, top};
  }

 private:
  std::size_t columns_, rows_;
  double width_, height_, plot_height_;  // of one panel
};

std::string head(const SpeedReport& report, const std::string& terminal, const std::string& output,
                 const Canvas& canvas) {
  const Environment& at = report.environment;
  return fmt::format(
      "set terminal {} size {:.0f},{:.0f} font ',11' background 'white'\nset output '{}'\n"
      "set encoding utf8\n"
      "set multiplot title \"Time per sample over that of {},\\n"
      "random directions and roughness\\n{}, {}, {}\" noenhanced font ',11'\n"
      "set logscale xy\nset tics nomirror\nset grid xtics ytics lt 1 lc rgb '#dddddd'\n"
      "set ytics (0.1, 0.2, 0.3, 0.5, 0.7, 1, 1.5, 2, 3, 5, 7, 10, 20, 50, 100)\n"
      "set xlabel 'bytes'\nset ylabel 'time'\n",
      terminal, canvas.width, canvas.height, output, report.entries.front().name, at.processor,
      at.compiler, at.date);
}

}  // namespace

std::string speed_plot(const SpeedReport& report, const std::string& terminal,
                       const std::string& output) {
  std::vector<SpeedPanel> panels;
  for (const std::string& d : distributions(report)) panels.emplace_back(report, d);
  if (panels.empty()) throw std::invalid_argument("no sampler has a u-error to draw; time others");
  const Grid grid(panels);
  const Canvas canvas = grid.canvas();
  // The legend consists of labels, which come with the first plot.
  std::string text = head(report, terminal, output, canvas) + legend(signs_of(panels), canvas);
  for (std::size_t k = 0; k < panels.size(); ++k)
    text += panels[k].script(canvas, grid.plot(k), kGap);
  return text + "unset multiplot\n";
}

}  // namespace vndf::bench
