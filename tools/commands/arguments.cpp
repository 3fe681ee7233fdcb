// Rules for numbers on the command line.
#include "commands/arguments.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace vndf::tools {
namespace {

/// Whether all of `text` is a number that T holds.
template <class T>
bool parse(const std::string& text, T& number) {
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && stop == end;
}

}  // namespace

CLI::Validator whole_number(std::uint64_t lowest, std::uint64_t highest) {
  const auto rule = [=](const std::string& text) -> std::string {
    std::uint64_t number = 0;
    // CLI11 would take a leading 0 for octal digits.
    if (parse(text, number) && text == fmt::to_string(number) && number >= lowest &&
        number <= highest)
      return {};
    return fmt::format("'{}' is not a whole number from {} to {} in decimal digits", text, lowest,
                       highest);
  };
  return {rule, ""};
}

CLI::Validator positive_number() {
  const auto rule = [](const std::string& text) -> std::string {
    double number = 0;
    if (parse(text, number) && number > 0 && std::isfinite(number)) return {};
    return fmt::format("'{}' is not a finite number > 0", text);
  };
  return {rule, ""};
}

CLI::Validator number_between(double lowest, double highest) {
  const auto rule = [=](const std::string& text) -> std::string {
    double number = 0;
    if (parse(text, number) && number >= lowest && number <= highest) return {};
    return fmt::format("'{}' is not a number from {:g} to {:g}", text, lowest, highest);
  };
  return {rule, ""};
}

CLI::Validator number_inside(double lowest, double highest) {
  const auto rule = [=](const std::string& text) -> std::string {
    double number = 0;
    if (parse(text, number) && number > lowest && number < highest) return {};
    return fmt::format("'{}' is not a number inside ({:g}, {:g})", text, lowest, highest);
  };
  return {rule, ""};
}

CLI::Validator finite_number() {
  const auto rule = [](const std::string& text) -> std::string {
    double number = 0;
    if (parse(text, number) && std::isfinite(number)) return {};
    return fmt::format("'{}' is not a finite number", text);
  };
  return {rule, ""};
}

void exclude_others(CLI::App& command, CLI::Option* flag) {
  for (CLI::Option* option : command.get_options())
    if (option != flag && option != command.get_help_ptr()) flag->excludes(option);
}

void add_threads(CLI::App& command, unsigned& threads) {
  command.add_option("--threads", threads, "Threads; 0 for one per processor")
      ->check(whole_number(0, kMostThreads))
      ->capture_default_str();
}

}  // namespace vndf::tools
