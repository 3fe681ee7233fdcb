// Reading radial profiles from text.
#include "vndf/distributions/profile_csv.h"

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

class Reader {
 public:
  Reader(std::istream& stream, const std::string& name) : csv_(stream, name) {}

  RadialProfile read() {
    columns_ = header();
    while (csv_.next_line()) add_sample();
    if (profile_.r.size() < kFewestSamples)
      csv_.fail("it has " + std::to_string(profile_.r.size()) + " samples; at least 4 are needed");
    return std::move(profile_);
  }

 private:
  Columns header() {
    if (!csv_.next_line()) csv_.fail("it is empty; " + accepted());
    const auto& fields = csv_.fields();
    for (const Columns& columns : kColumns)
      if (fields.size() == 2 && fields[0] == columns.first && fields[1] == columns.second)
        return columns;
    csv_.fail_in_line("the header " + support::quoted(csv_.line()) + " is not known; " +
                      accepted());
  }

  static std::string accepted() {
    std::string list = "the first line must be one of";
    for (const Columns& columns : kColumns) list += " '" + std::string(columns.header) + "'";
    return list;
  }

  void add_sample() {
    if (csv_.fields().size() != 2)
      csv_.fail_in_line("two numbers are needed, separated by a comma");
    const double place = csv_.number(csv_.fields()[0]);
    const double density = csv_.number(csv_.fields()[1]);
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
      csv_.fail_in_line(first + " must lie in " +
                        (columns_.angle_unit == 1 ? "[0, pi/2), in radians" : "[0, 90)"));
    if (density < 0) csv_.fail_in_line(std::string(columns_.second) + " must not be negative");
    if (profile_.r.size() == kMostSamples)
      csv_.fail_in_line("there are more than " + std::to_string(kMostSamples) + " samples");
  }

  bool in_quarter_turn(double place) const {
    return place >= 0 && place * columns_.angle_unit < std::numbers::pi / 2;
  }

  support::CsvReader csv_;
  Columns columns_{};
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
