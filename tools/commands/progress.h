// How far a long command is, in one line on standard error that goes when the command is done. It
// is drawn only on a terminal, because in a file it would be in the way of messages.
#pragma once

#include <chrono>
#include <string>

#include "vndf/support/parallel.h"

namespace vndf::tools {

class Progress {
 public:
  /// Draws nothing if not `wanted`, or if standard error is no terminal.
  explicit Progress(bool wanted = true);
  ~Progress() { erase(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Begins a step, of which nothing is done yet.
  void begin(const std::string& step);
  /// Shows how much of the step is done, from 0 to 1, and how long the rest will take.
  void show(double fraction);
  /// Removes the line, so that something else can be printed.
  void erase();

  /// Workers that show their progress here, which must outlive them.
  support::Workers workers(unsigned threads);

 private:
  using Clock = std::chrono::steady_clock;

  void draw(const std::string& line);

  bool drawn_;            ///< whether anything is drawn at all
  bool visible_ = false;  ///< whether a line is there now
  std::string step_;
  Clock::time_point began_, shown_;
};

}  // namespace vndf::tools
