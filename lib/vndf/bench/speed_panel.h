// One distribution in the picture of a benchmark: bytes across, time upwards, names beside.
#pragma once

#include <string>
#include <vector>

#include "vndf/bench/label_places.h"
#include "vndf/bench/speed_report.h"

namespace vndf::bench {

/// What the script draws on, in pixels, y upwards.
struct Canvas {
  double width, height;

  /// `p` in the coordinates of gnuplot.
  std::string at(const Place& p) const;
  /// Small text whose left end, middle or right end ("left", "center", "right") is at `p`.
  std::string label(const Place& p, const std::string& text, const char* side,
                    const char* colour) const;
  std::string mark(const Place& p, int point, const char* colour) const;
};

/// How wide and high a character of a label is at most.
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

/// The tolerance 10^power that an entry keeps by its u-error: fronts and colours go by it.
int power_of(const SpeedEntry& entry);
const char* colour_of(int power);

class SpeedPanel {
 public:
  struct KeyRow {
    std::string text;
    const char* colour;
  };

  /// Refers to the entries of `report`.
  SpeedPanel(const SpeedReport& report, const std::string& distribution);

  /// Entries with bytes, by bytes: the first has the number 1.
  const std::vector<const SpeedEntry*>& marks() const { return marks_; }
  /// The names of the numbers, and the ratios of entries without tables, as some of their lines may
  /// be off the axis or too close for a name.
  std::vector<KeyRow> key() const;
  /// Draws the plot in `plot`, and the key to the right of it, `gap` away.
  std::string script(const Canvas& canvas, const Box& plot, double gap) const;

 private:
  using Entries = std::vector<const SpeedEntry*>;

  /// A logarithmic axis.
  struct Axis {
    double low, high;

    /// 0 at the low end, 1 at the high one.
    double at(double value) const;
  };
  /// Of those that keep a tolerance, the entries that no other beats in bytes and time at once.
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
