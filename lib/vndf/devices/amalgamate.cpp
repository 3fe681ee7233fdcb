// Puts headers in the place of their #include.
#include "vndf/devices/amalgamate.h"

#include <set>
#include <sstream>

#include "vndf/devices/embedded_text.h"

namespace vndf::devices {
namespace {

class Amalgam {
 public:
  void add(std::string_view header) {
    if (!added_.emplace(header).second) return;
    std::istringstream lines{std::string(embedded_text(header))};
    int conditions = 0;
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with("#if")) ++conditions;
      if (line.starts_with("#endif")) --conditions;
      add_line(line, conditions > 0);
    }
  }

  std::string text() const {
    std::string all;
    for (const std::string& line : standard_) all += line + "\n";
    return all + text_;
  }

 private:
  void add_line(const std::string& line, bool conditional) {
    constexpr std::string_view kOwn = "#include \"", kStandard = "#include <";
    if (line.starts_with(kOwn))
      add(std::string_view(line).substr(kOwn.size(), line.size() - kOwn.size() - 1));
    else if (line.starts_with(kStandard) && !conditional)
      standard_.insert(line);
    else if (line != "#pragma once")
      text_ += line + "\n";
  }

  std::set<std::string, std::less<>> added_;
  std::set<std::string> standard_;
  std::string text_;
};

}  // namespace

std::string amalgamate(std::string_view header) {
  Amalgam amalgam;
  amalgam.add(header);
  return amalgam.text();
}

}  // namespace vndf::devices
