// Rules for numbers on the command line, each with a message that names the value and the rule.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>

namespace vndf::tools {

/// More threads than any machine runs, and few enough to be started.
inline constexpr std::uint64_t kMostThreads = 4096;

/// A whole number from `lowest` to `highest`, in decimal digits.
CLI::Validator whole_number(std::uint64_t lowest = 0, std::uint64_t highest = UINT64_MAX);

/// A finite number > 0.
CLI::Validator positive_number();

/// A number from `lowest` to `highest`.
CLI::Validator number_between(double lowest, double highest);

/// A number between `lowest` and `highest`, neither of which it is.
CLI::Validator number_inside(double lowest, double highest);

/// A finite number.
CLI::Validator finite_number();

/// Makes `flag` exclude every other option of the command but --help: one that would be ignored
/// beside it is wrong usage.
void exclude_others(CLI::App& command, CLI::Option* flag);

/// Adds --threads.
void add_threads(CLI::App& command, unsigned& threads);

}  // namespace vndf::tools
