// Lines of comma-separated numbers, read strictly: blank lines, lines that start with '#', blanks
// around fields, line ends of other systems and a byte order mark pass; anything else that is not
// expected is refused with the file, the line and the rule.
#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <istream>
#include <string>
#include <string_view>
#include <vector>

namespace vndf::support {

/// Opens the file at `path` to be read by a CsvReader. Throws std::runtime_error, naming it, if it
/// is no regular file or cannot be read.
std::ifstream open_csv(const std::filesystem::path& path);

class CsvReader {
 public:
  /// `name` stands for the file in messages. `stream` must outlive this object.
  CsvReader(std::istream& stream, std::string name) : stream_(stream), name_(std::move(name)) {}

  /// Goes to the next line that says something; false at the end.
  bool next_line();
  /// Its text, and its fields; both valid until the next line.
  std::string_view line() const { return line_; }
  const std::vector<std::string_view>& fields() const { return fields_; }
  std::size_t line_number() const { return line_number_; }

  /// The finite number that `field` is.
  double number(std::string_view field) const;

  /// Throw std::runtime_error with the file, or the file and the line, and `rule`.
  [[noreturn]] void fail(const std::string& rule) const;
  [[noreturn]] void fail_in_line(const std::string& rule) const;

 private:
  std::istream& stream_;
  std::string name_, text_;
  std::string_view line_;
  std::vector<std::string_view> fields_;
  std::size_t line_number_ = 0;
};

}  // namespace vndf::support
