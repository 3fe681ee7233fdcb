// One panel of the picture of a benchmark, which shows one distribution: bytes across, time upwards
// and the names beside the plot.
#pragma once

#include <string>
#include <vector>

#include "vndf/bench/label_places.h"
#include "vndf/bench/speed_report.h"

namespace vndf::bench {

/// The picture that a script draws, in pixels with y upwards.
struct Canvas {
  double width, height;

  /// The point `p` in the coordinates of gnuplot.
  std::string at(const Place& p) const;
  /// Small text whose left end, middle or right end ("left", "center", "right") is at `p`.
  std::string label(const Place& p, const std::string& text, const char* side,
                    const char* colour) const;
  std::string mark(const Place& p, int point, const char* colour) const;
};

/// Largest width and height of a character of a label.
inline constexpr double kCharacterWidth = 6, kCharacterHeight = 12;

/// How the marks of a kind look.
struct Look {
  Kind kind;
  const char* title;
  int point;  ///< of gnuplot's
};
inline constexpr Look kLooks[] = {{Kind::literal, "tables of the paper, read literally", 2},
                                  {Kind::table, "tables", 7},
                                  {Kind::kernel, "kernels", 9}};

/// The power of ten that is the smallest tolerance of an entry, given its u-error, and the colour
/// of that power.
int power_of(const SpeedEntry& entry);
const char* colour_of(int power);

/// The layout and the script of one panel.
class SpeedPanel {
 public:
  /// One line of the key.
  struct KeyRow {
    std::string text;
    const char* colour;
  };

  /// Refers to the entries of `report`.
  SpeedPanel(const SpeedReport& report, const std::string& distribution);

  /// Entries with tables, by size. The plot numbers them from 1.
  const std::vector<const SpeedEntry*>& marks() const { return marks_; }
  /// The names of the numbers, and the ratios of entries without tables, whose lines may be outside
  /// the plot or too close together for names.
  std::vector<KeyRow> key() const;
  /// Draws the plot in `plot`, and the key to the right of it at a distance of `gap`.
  std::string script(const Canvas& canvas, const Box& plot, double gap) const;

 private:
  using Entries = std::vector<const SpeedEntry*>;

  /// A logarithmic axis.
  struct Axis {
    double low, high;

    /// 0 at the low end, 1 at the high one.
    double at(double value) const;
  };
  /// The Pareto front in bytes and time of the entries whose u-error is within a tolerance.
  struct Front {
    int power;
    Entries steps;
  };
  struct Drawing;

  static Axis axis_around(const std::vector<double>& values, double room);
  Front front_of(int power) const;
  bool on_front(const SpeedEntry& entry) const;
  std::string short_name(const SpeedEntry& entry) const;
  std::vector<double> ratios_to_show() const;

  std::string distribution_;
  Entries marks_, lines_;
  std::vector<Front> fronts_;
  Axis bytes_, time_;
};

}  // namespace vndf::bench
