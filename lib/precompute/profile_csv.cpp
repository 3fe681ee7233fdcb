// Reading radial profiles from text.
#include "precompute/profile_csv.h"

#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <system_error>

namespace vndf::precompute {
namespace {

constexpr std::size_t kFewestSamples = 4, kMostSamples = 1u << 20;

/// What the header says of the first column; the second is D where `angle_unit` is set.
struct Columns {
  std::string_view header, first, second;
  double angle_unit;  // radians in one; 0: the column is a radius
};

constexpr std::array<Columns, 3> kColumns{
    {{"r,p22", "r", "p22", 0},
     {"theta,D", "theta", "D", 1},
     {"theta_deg,D", "theta_deg", "D", std::numbers::pi / 180}}};

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

class Reader {
 public:
  Reader(std::istream& stream, const std::string& name) : stream_(stream), name_(name) {}

  RadialProfile read() {
    columns_ = header();
    while (next_line()) add_sample();
    if (profile_.r.size() < kFewestSamples)
      fail("it has " + std::to_string(profile_.r.size()) + " samples; at least 4 are needed");
    return std::move(profile_);
  }

 private:
  [[noreturn]] void fail(const std::string& rule) const { fail_at(name_, rule); }
  [[noreturn]] void fail_in_line(const std::string& rule) const {
    fail_at(name_ + ", line " + std::to_string(line_number_), rule);
  }
  [[noreturn]] static void fail_at(const std::string& place, const std::string& rule) {
    throw std::runtime_error(place + ": " + rule);
  }

  /// Goes to the next line that says something; false at the end.
  bool next_line() {
    while (std::getline(stream_, text_)) {
      ++line_number_;
      if (line_number_ == 1 && text_.starts_with("\xEF\xBB\xBF")) text_.erase(0, 3);
      line_ = trimmed(text_);
      if (!line_.empty() && line_[0] != '#') return true;
    }
    if (stream_.bad()) fail("it cannot be read");
    return false;
  }

  Columns header() {
    if (!next_line()) fail("it is empty; " + accepted());
    const std::size_t comma = std::min(line_.find(','), line_.size());
    const std::string_view first = trimmed(line_.substr(0, comma));
    const std::string_view second = trimmed(line_.substr(std::min(comma + 1, line_.size())));
    for (const Columns& columns : kColumns)
      if (first == columns.first && second == columns.second) return columns;
    fail_in_line("the header '" + std::string(line_.substr(0, 60)) + "' is not known; " +
                 accepted());
  }

  static std::string accepted() {
    std::string list = "the first line must be one of";
    for (const Columns& columns : kColumns) list += " '" + std::string(columns.header) + "'";
    return list;
  }

  double number(std::string_view text) const {
    const std::string_view digits = text.starts_with('+') ? text.substr(1) : text;
    double value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc() || end != digits.data() + digits.size() || !std::isfinite(value))
      fail_in_line(std::string("'").append(text.substr(0, 60)).append("' is not a finite number"));
    return value;
  }

  void add_sample() {
    const std::size_t comma = line_.find(',');
    if (comma == std::string_view::npos || line_.find(',', comma + 1) != std::string_view::npos)
      fail_in_line("two numbers are needed, separated by a comma");
    const double place = number(trimmed(line_.substr(0, comma)));
    const double density = number(trimmed(line_.substr(comma + 1)));
    check(place, density);
    const double theta = place * columns_.angle_unit;
    const double cosine = std::cos(theta);  // 1 for a radius
    profile_.r.push_back(columns_.angle_unit == 0 ? place : std::tan(theta));
    profile_.p22.push_back(density * (cosine * cosine) * (cosine * cosine));
    last_ = place;
  }

  void check(double place, double density) const {
    const std::string first(columns_.first);
    if (last_ && place == *last_) fail_in_line(first + " is the same as in the sample before");
    if (last_ && place < *last_) fail_in_line(first + " must increase from sample to sample");
    if (columns_.angle_unit == 0 && place < 0) fail_in_line("r must not be negative");
    if (columns_.angle_unit != 0 && !in_quarter_turn(place))
      fail_in_line(first + " must lie in " +
                   (columns_.angle_unit == 1 ? "[0, pi/2), in radians" : "[0, 90)"));
    if (density < 0) fail_in_line(std::string(columns_.second) + " must not be negative");
    if (profile_.r.size() == kMostSamples)
      fail_in_line("there are more than " + std::to_string(kMostSamples) + " samples");
  }

  bool in_quarter_turn(double place) const {
    return place >= 0 && place * columns_.angle_unit < std::numbers::pi / 2;
  }

  std::istream& stream_;
  const std::string& name_;
  std::string text_;
  std::string_view line_;
  std::size_t line_number_ = 0;
  Columns columns_{};
  std::optional<double> last_;
  RadialProfile profile_;
};

}  // namespace

RadialProfile read_profile_csv(std::istream& stream, const std::string& name) {
  return Reader(stream, name).read();
}

RadialProfile read_profile_csv(const std::filesystem::path& path) {
  std::error_code error;
  std::ifstream stream(path, std::ios::binary);
  if (!std::filesystem::is_regular_file(path, error) || !stream)
    throw std::runtime_error(path.string() + ": there is no such file, or it cannot be read");
  return read_profile_csv(stream, path.string());
}

}  // namespace vndf::precompute
