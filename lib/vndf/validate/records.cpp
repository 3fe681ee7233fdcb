// Reading samples of somebody's sampler.
#include "vndf/validate/records.h"

#include <array>
#include <cmath>
#include <random>
#include <stdexcept>
#include <string_view>

#include "vndf/support/csv_reader.h"
#include "vndf/support/text.h"

namespace vndf::validate {
namespace {

using support::CsvReader;

/// Which columns are there, and their names in order.
struct Header {
  bool surface, u, pdf;

  std::vector<std::string_view> columns() const {
    std::vector<std::string_view> names{"wx", "wy", "wz", "ax", "ay"};
    if (surface) names.insert(names.end(), {"correlation", "mean_x", "mean_y"});
    if (u) names.insert(names.end(), {"u1", "u2"});
    names.insert(names.end(), {"mx", "my", "mz"});
    if (pdf) names.push_back("pdf");
    return names;
  }
};

Header read_header(support::CsvReader& csv) {
  const std::string accepted =
      "the first line must be 'wx,wy,wz,ax,ay,u1,u2,mx,my,mz', where u1,u2 may be missing, pdf may "
      "follow, and correlation,mean_x,mean_y may stand after ay";
  if (!csv.next_line()) csv.fail("it is empty; " + accepted);
  for (const bool surface : {false, true})
    for (const bool u : {true, false})
      for (const bool pdf : {false, true})
        if (csv.fields() == Header{surface, u, pdf}.columns()) return {surface, u, pdf};
  csv.fail_in_line("the header " + support::quoted(csv.line()) + " is not known; " + accepted);
}

/// Whether `v` is a unit vector to kLengthSlack.
bool has_length_one(const Vec3<double>& v) {
  return std::abs(std::hypot(v.x, v.y, v.z) - 1) <= kLengthSlack;
}

bool is_probability_or_unknown(double u) {
  return std::isnan(u) || (u >= 0 && u <= 1);
}

bool is_roughness(double alpha) {
  return alpha >= kSmallestRoughness && alpha <= kLargestRoughness;
}

bool is_mean_slope(double slope) {
  return std::abs(slope) <= kLargestMeanSlope;
}

Record read_record(const support::CsvReader& csv, const Header& header) {
  const auto& fields = csv.fields();
  const std::size_t columns = header.columns().size();
  if (fields.size() != columns)
    csv.fail_in_line("it has " + std::to_string(fields.size()) + " fields; the header has " +
                     std::to_string(columns));
  std::size_t next = 0;
  const auto number = [&] { return csv.number(fields[next++]); };
  const auto vector = [&] {
    const double x = number(), y = number();
    return Vec3<double>{x, y, number()};
  };
  Record r;
  r.configuration.wi = vector();
  Configuration& c = r.configuration;
  c.alpha.x = number();
  c.alpha.y = number();
  if (header.surface) {
    c.correlation = number();
    c.mean.x = number();
    c.mean.y = number();
  }
  if (header.u) {
    r.u1 = number();
    r.u2 = number();
  }
  r.wm = vector();
  if (header.pdf) r.pdf = number();

  if (const auto rule = broken_rule(r)) csv.fail_in_line(*rule);
  return r;
}

}  // namespace

std::optional<std::string> broken_rule(const Record& r) {
  const Configuration& c = r.configuration;
  if (!has_length_one(c.wi)) return "wx,wy,wz must have length 1";
  if (!is_roughness(c.alpha.x) || !is_roughness(c.alpha.y))
    return "ax and ay must be from 1e-9 to 1e9";
  if (!(std::abs(c.correlation) < 1)) return "correlation must be inside (-1, 1)";
  if (!is_mean_slope(c.mean.x) || !is_mean_slope(c.mean.y))
    return "mean_x and mean_y must be from -1e9 to 1e9";
  if (!is_probability_or_unknown(r.u1) || !is_probability_or_unknown(r.u2))
    return "u1 and u2 must be in [0, 1]";
  if (!has_length_one(r.wm)) return "mx,my,mz must have length 1";
  return {};
}

Records read_records(std::istream& stream, const std::string& name, std::size_t most) {
  support::CsvReader csv(stream, name);
  const Header header = read_header(csv);
  Records records{{}, header.u, header.pdf};
  std::mt19937_64 random;
  while (csv.next_line()) {
    const Record record = read_record(csv, header);
    ++records.read;
    if (records.list.size() < most) {
      records.list.push_back(record);
      continue;
    }
    const std::size_t place = random() % records.read;
    if (place < most) records.list[place] = record;
  }
  return records;
}

Records read_records(const std::filesystem::path& path) {
  std::ifstream stream = support::open_csv(path);
  return read_records(stream, path.string());
}

}  // namespace vndf::validate
