// Reading radial profiles from text.
#include "vndf/distributions/profile_csv.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "vndf/support/csv_reader.h"
#include "vndf/support/text.h"

namespace vndf::distributions {
namespace {

constexpr std::size_t kMostSamples = 1u << 20;

/// Two columns that make a profile; the second is D where `angle_unit` is set.
struct Columns {
  std::string_view header, first, second;
  double angle_unit;  // radians in one; 0: the column is a radius
};

constexpr std::array<Columns, 3> kColumns{
    {{"r,p22", "r", "p22", 0},
     {"theta,D", "theta", "D", 1},
     {"theta_deg,D", "theta_deg", "D", std::numbers::pi / 180}}};

class Reader {
 public:
  Reader(std::istream& stream, const std::string& name) : csv_(stream, name) {}

  RadialProfile read() {
    columns_ = header();
    while (csv_.next_line()) add_sample();
    if (profile_.r.size() < kFewestProfileSamples)
      csv_.fail("it has " + std::to_string(profile_.r.size()) + " samples; at least 4 are needed");
    return std::move(profile_);
  }

 private:
  Columns header() {
    if (!csv_.next_line()) csv_.fail("it is empty; " + accepted());
    const auto& fields = csv_.fields();
    width_ = fields.size();
    const auto place_of = [&](std::string_view name) {
      return static_cast<std::size_t>(std::ranges::find(fields, name) - fields.begin());
    };
    for (const Columns& columns : kColumns) {
      first_ = place_of(columns.first);
      second_ = place_of(columns.second);
      if (first_ < width_ && second_ < width_) return columns;
    }
    csv_.fail_in_line("the header " + support::quoted(csv_.line()) + " is not known; " +
                      accepted());
  }

  static std::string accepted() {
    std::string list = "the first line must name the columns of one of";
    for (const Columns& columns : kColumns) list += " '" + std::string(columns.header) + "'";
    return list;
  }

  void add_sample() {
    const auto& fields = csv_.fields();
    if (fields.size() != width_)
      csv_.fail_in_line("the line has " + std::to_string(fields.size()) +
                        " fields and the header " + std::to_string(width_) +
                        "; separate as many by commas");
    const double place = csv_.number(fields[first_]);
    const double density = csv_.number(fields[second_]);
    check(place, density);
    const double theta = place * columns_.angle_unit;
    const double cosine = std::cos(theta);  // 1 for a radius
    profile_.r.push_back(columns_.angle_unit == 0 ? place : std::tan(theta));
    profile_.p22.push_back(density * (cosine * cosine) * (cosine * cosine));
    last_ = place;
  }

  void check(double place, double density) const {
    const std::string first(columns_.first);
    if (last_ && place == *last_) csv_.fail_in_line(first + " is the same as in the sample before");
    if (last_ && place < *last_) csv_.fail_in_line(first + " must increase from sample to sample");
    if (columns_.angle_unit == 0 && place < 0) csv_.fail_in_line("r must not be negative");
    if (columns_.angle_unit != 0 && !in_quarter_turn(place))
      csv_.fail_in_line(
          first + " must lie in " +
          (columns_.angle_unit == 1
               ? "[0, pi/2), in radians; name the column theta_deg if it is in degrees"
               : "[0, 90), in degrees"));
    if (density < 0) csv_.fail_in_line(std::string(columns_.second) + " must not be negative");
    if (profile_.r.size() == kMostSamples)
      csv_.fail_in_line("there are more than " + std::to_string(kMostSamples) + " samples");
  }

  bool in_quarter_turn(double place) const {
    return place >= 0 && place * columns_.angle_unit < std::numbers::pi / 2;
  }

  support::CsvReader csv_;
  Columns columns_{};
  std::size_t width_ = 0, first_ = 0, second_ = 0;  // fields in a line, and the two that count
  std::optional<double> last_;
  RadialProfile profile_;
};

}  // namespace

RadialProfile read_profile_csv(std::istream& stream, const std::string& name) {
  return Reader(stream, name).read();
}

RadialProfile read_profile_csv(const std::filesystem::path& path) {
  std::ifstream stream = support::open_csv(path);
  return read_profile_csv(stream, path.string());
}

}  // namespace vndf::distributions
