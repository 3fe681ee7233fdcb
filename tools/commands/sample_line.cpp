// Reading lines of numbers.
#include "commands/sample_line.h"

#include <charconv>
#include <stdexcept>

namespace vndf::tools {

bool next_sample_line(std::istream& stream, std::string& line) {
  line.clear();
  std::streambuf& input = *stream.rdbuf();
  using Traits = std::char_traits<char>;
  for (auto c = input.sbumpc(); c != '\n'; c = input.sbumpc()) {
    if (Traits::eq_int_type(c, Traits::eof())) return !line.empty();
    if (line.size() == kMostLineBytes)
      throw std::runtime_error("it is longer than " + std::to_string(kMostLineBytes) +
                               " bytes; give wx wy wz ax ay u1 u2");
    line += Traits::to_char_type(c);
  }
  return true;
}

SampleInputs numbers_of(const std::string& line) {
  SampleInputs inputs{};
  const char* at = line.data();
  const char* end = at + line.size();
  const auto skip_blanks = [&] {
    while (at < end && (*at == ' ' || *at == '\t' || *at == '\r')) ++at;
  };
  for (double& value : inputs) {
    skip_blanks();
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc())
      throw std::runtime_error("expected seven numbers: wx wy wz ax ay u1 u2");
    at = next;
  }
  skip_blanks();
  if (at != end) throw std::runtime_error("more than the seven numbers wx wy wz ax ay u1 u2");
  return inputs;
}

}  // namespace vndf::tools
