// What the program says on standard error. Texts in messages come from files and arguments, so that
// all pass here, where they are made printable.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace vndf::tools {

/// Bytes of a message, about ten lines of a terminal. What is longer quotes something endless.
inline constexpr std::size_t kMostMessageBytes = 1000;

/// Prints "vndf: " and `message` in one line.
void print_failure(const std::string& message);

/// Prints "vndf: warning: " and `message` in one line, also with --quiet: a warning says that a
/// result may not be what was asked for.
void print_warning(const std::string& message);

/// Prints what is wrong with the command line, or the help or version that it asks for. An unknown
/// subcommand or option is named with the one that it may have meant. Returns the exit status.
int show(const CLI::App& app, const CLI::ParseError& error);

}  // namespace vndf::tools
