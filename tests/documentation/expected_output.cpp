// Compares words: a word is a number, one other character, or a run of letters.
#include "documentation/expected_output.h"

#include <cmath>
#include <cstdlib>
#include <regex>
#include <sstream>
#include <vector>

namespace vndf::documentation {
namespace {

const std::string kAnything = "...";

using Words = std::vector<std::string>;

Words words_of(const std::string& line) {
  static const std::regex kWord("\\.\\.\\.|[0-9]+(\\.[0-9]+)?([eE][-+]?[0-9]+)?|[A-Za-z_]+|[^\\s]");
  Words words;
  for (std::sregex_iterator i(line.begin(), line.end(), kWord), end; i != end; ++i)
    words.push_back(i->str());
  return words;
}

bool is_number(const std::string& word) {
  return word[0] >= '0' && word[0] <= '9';
}

bool same_word(const std::string& expected, const std::string& actual, double tolerance) {
  if (expected == actual) return true;
  if (!is_number(expected) || !is_number(actual)) return false;
  const double e = std::strtod(expected.c_str(), nullptr);
  const double a = std::strtod(actual.c_str(), nullptr);
  return std::abs(e - a) <= tolerance * std::abs(e);
}

bool same_line(const Words& expected, std::size_t i, const Words& actual, std::size_t j,
               double tolerance) {
  if (i == expected.size()) return j == actual.size();
  if (expected[i] == kAnything) {
    for (; j <= actual.size(); ++j)
      if (same_line(expected, i + 1, actual, j, tolerance)) return true;
    return false;
  }
  return j < actual.size() && same_word(expected[i], actual[j], tolerance) &&
         same_line(expected, i + 1, actual, j + 1, tolerance);
}

std::vector<Words> lines_of(const std::string& text, std::vector<std::string>* raw = nullptr) {
  std::vector<Words> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    const Words words = words_of(line);
    if (words.empty()) continue;
    lines.push_back(words);
    if (raw != nullptr) raw->push_back(line);
  }
  return lines;
}

}  // namespace

std::string first_difference(const std::string& expected, const std::string& actual,
                             double tolerance) {
  std::vector<std::string> text;
  const auto wanted = lines_of(expected, &text);
  const auto printed = lines_of(actual);
  const Words any_lines{kAnything};
  std::size_t next = 0;
  bool skipping = false;  // after a line "...": the next wanted line may be anywhere below
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (wanted[i] == any_lines) {
      skipping = true;
      continue;
    }
    const auto matches = [&] {
      return next < printed.size() && same_line(wanted[i], 0, printed[next], 0, tolerance);
    };
    while (skipping && next < printed.size() && !matches()) ++next;
    if (!matches()) return text[i];
    ++next;
    skipping = false;
  }
  return skipping || next == printed.size() ? "" : "(nothing more)";
}

}  // namespace vndf::documentation
