// Reading lines of numbers.
#include "commands/sample_line.h"

#include <charconv>
#include <stdexcept>
#include <vector>

namespace vndf::tools {
namespace {

/// Numbers of a line without correlation and mean slope, and of these.
constexpr std::size_t kPlain = 7, kTilt = 3;

}  // namespace

bool next_sample_line(std::istream& stream, std::string& line) {
  line.clear();
  std::streambuf& input = *stream.rdbuf();
  using Traits = std::char_traits<char>;
  for (auto c = input.sbumpc(); c != '\n'; c = input.sbumpc()) {
    if (Traits::eq_int_type(c, Traits::eof())) return !line.empty();
    if (line.size() == kMostLineBytes)
      throw std::runtime_error("it is longer than " + std::to_string(kMostLineBytes) +
                               " bytes; give " + kLineForm);
    line += Traits::to_char_type(c);
  }
  return true;
}

SampleInputs inputs_of(const std::string& line) {
  const auto wrong = [] {
    return std::runtime_error(std::string("give seven numbers or ten: ") + kLineForm);
  };
  std::vector<double> numbers;
  const char* at = line.data();
  const char* end = at + line.size();
  const auto skip_blanks = [&] {
    while (at < end && (*at == ' ' || *at == '\t' || *at == '\r')) ++at;
  };
  for (skip_blanks(); at < end; skip_blanks()) {
    const auto [next, error] = std::from_chars(at, end, numbers.emplace_back());
    if (error != std::errc()) throw wrong();
    at = next;
  }
  if (numbers.size() != kPlain && numbers.size() != kPlain + kTilt) throw wrong();
  SampleInputs inputs{{numbers[0], numbers[1], numbers[2]},
                      {{numbers[3], numbers[4]}},
                      numbers.end()[-2],
                      numbers.end()[-1]};
  if (numbers.size() == kPlain) return inputs;
  inputs.surface.correlation = numbers[5];
  inputs.surface.mean = {numbers[6], numbers[7]};
  return inputs;
}

}  // namespace vndf::tools
