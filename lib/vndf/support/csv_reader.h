// Reads lines of comma-separated numbers, strictly. Blank lines, lines that start with '#', blanks
// around fields, line ends of Windows and a byte order mark are skipped. Anything else that is not
// expected is an error that names the file, the line and the rule. The memory that a file takes is
// that of its longest line, which is limited.
#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <istream>
#include <string>
#include <string_view>
#include <vector>

namespace vndf::support {

/// Opens the file at `path` for a CsvReader. Throws std::runtime_error, which names the file, if it
/// is not a regular file or cannot be read.
std::ifstream open_csv(const std::filesystem::path& path);

/// Longest line in bytes. A line of numbers takes a few hundred.
inline constexpr std::size_t kMaxCsvLine = 8192;

class CsvReader {
 public:
  /// `name` stands for the file in messages. `stream` must outlive this object.
  CsvReader(std::istream& stream, std::string name)
      : stream_(stream), name_(std::move(name)), buffer_(kMaxCsvLine + 1) {}

  /// Goes to the next line that is neither blank nor a comment. Returns false at the end of the
  /// stream. Throws std::runtime_error if the stream cannot be read, and for a line that is longer
  /// than kMaxCsvLine or holds a zero byte.
  bool next_line();
  /// The text of the line and its fields, without blanks around them. Both are valid until the next
  /// line.
  std::string_view line() const { return line_; }
  const std::vector<std::string_view>& fields() const { return fields_; }
  std::size_t line_number() const { return line_number_; }

  /// Returns the number that `field` spells. Throws as fail_in_line() does unless it is finite.
  double number(std::string_view field) const;

  /// Throw std::runtime_error with the file and `rule`, and with the line.
  [[noreturn]] void fail(const std::string& rule) const;
  [[noreturn]] void fail_in_line(const std::string& rule) const;

 private:
  bool read_line();

  std::istream& stream_;
  std::string name_;
  std::vector<char> buffer_;  // holds a line and a zero behind it
  std::string_view line_;
  std::vector<std::string_view> fields_;
  std::size_t line_number_ = 0;
};

}  // namespace vndf::support
