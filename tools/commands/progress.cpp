// Drawing progress.
#include "commands/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <iostream>

#include "vndf/support/text.h"

namespace vndf::tools {
namespace {

// A line that is wider than the terminal cannot be erased: both fit into one of 80 columns.
constexpr std::size_t kWidth = 20;      // of the bar, in characters
constexpr std::size_t kStepBytes = 34;  // of the name of a step
constexpr std::chrono::milliseconds kPause{100};
constexpr double kSettled = 1;                // seconds after which the time left can be told
constexpr const char* kToStart = "\r\x1b[K";  // erases the line of a terminal

std::string bar(double fraction) {
  const auto full = static_cast<std::size_t>(fraction * kWidth);
  return fmt::format("[{:<{}}] {:3.0f} %", std::string(full, '#'), kWidth, 100 * fraction);
}

std::string time_left(double fraction, double seconds) {
  if (seconds < kSettled || fraction <= 0) return {};
  return fmt::format(", {:.0f} s left", seconds * (1 - fraction) / fraction);
}

}  // namespace

Progress::Progress(bool wanted) : drawn_(wanted && isatty(STDERR_FILENO) != 0) {}

void Progress::begin(const std::string& step) {
  step_ = support::printable(step, kStepBytes);
  began_ = shown_ = Clock::now();
  draw(step_);
}

void Progress::show(double fraction) {
  const auto now = Clock::now();
  if (now - shown_ < kPause) return;
  shown_ = now;
  const std::chrono::duration<double> seconds = now - began_;
  draw(fmt::format("{} {}{}", step_, bar(fraction), time_left(fraction, seconds.count())));
}

void Progress::erase() {
  if (visible_) std::cerr << kToStart << std::flush;
  visible_ = false;
}

support::Workers Progress::workers(unsigned threads) {
  if (!drawn_) return {threads};
  return {threads, [this](std::size_t done, std::size_t count) {
            show(static_cast<double>(done) / static_cast<double>(count));
          }};
}

void Progress::draw(const std::string& line) {
  if (!drawn_) return;
  std::cerr << kToStart << line << std::flush;
  visible_ = true;
}

}  // namespace vndf::tools
