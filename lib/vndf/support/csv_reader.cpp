// Cuts a line at its commas and reads each number independently of the locale.
#include "vndf/support/csv_reader.h"

#include <stdexcept>

#include "vndf/support/text.h"

namespace vndf::support {
namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

void split(std::string_view line, std::vector<std::string_view>& fields) {
  fields.clear();
  for (std::size_t comma = 0; comma != std::string_view::npos;) {
    comma = line.find(',');
    fields.push_back(trimmed(line.substr(0, comma)));
    line.remove_prefix(comma == std::string_view::npos ? line.size() : comma + 1);
  }
}

}  // namespace

std::ifstream open_csv(const std::filesystem::path& path) {
  const auto fail = [&](const char* why) { throw std::runtime_error(path.string() + ": " + why); };
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) fail("there is no such file; check the path");
  if (!std::filesystem::is_regular_file(status)) fail("it is not a file; give the path of a file");
  std::ifstream stream(path, std::ios::binary);
  if (!stream) fail("it cannot be read; check its permissions");
  return stream;
}

/// Reads one line into line_, without its end. Returns false at the end of the stream.
bool CsvReader::read_line() {
  stream_.getline(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
  auto length = static_cast<std::size_t>(stream_.gcount());
  if (length == 0) return false;
  ++line_number_;
  const bool ended = stream_.good();
  if (!ended && !stream_.eof())
    fail_in_line("the line is longer than " + std::to_string(kMaxCsvLine) +
                 " bytes; give a text file with one sample or record in each line");
  if (ended) --length;  // the line end is counted
  line_ = {buffer_.data(), length};
  if (line_.find('\0') != std::string_view::npos)
    fail_in_line("there is a zero byte; give a text file in ASCII or UTF-8");
  return true;
}

bool CsvReader::next_line() {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  while (read_line()) {
    if (line_number_ == 1 && line_.starts_with(kByteOrderMark))
      line_.remove_prefix(kByteOrderMark.size());
    line_ = trimmed(line_);
    if (line_.empty() || line_[0] == '#') continue;
    split(line_, fields_);
    return true;
  }
  if (stream_.bad()) fail("it cannot be read");
  return false;
}

double CsvReader::number(std::string_view field) const {
  const std::string_view digits = field.starts_with('+') ? field.substr(1) : field;
  const auto value = finite_number(digits);
  if (!value) fail_in_line(quoted(field) + " is not a finite number");
  return *value;
}

void CsvReader::fail(const std::string& rule) const {
  throw std::runtime_error(name_ + ": " + rule);
}

void CsvReader::fail_in_line(const std::string& rule) const {
  throw std::runtime_error(name_ + ", line " + std::to_string(line_number_) + ": " + rule);
}

}  // namespace vndf::support
