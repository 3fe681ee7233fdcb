// What the program says on standard error.
#include "commands/messages.h"

#include <iostream>
#include <vector>

#include "vndf/support/text.h"

namespace vndf::tools {
namespace {

void print_line(const std::string& start, const std::string& message) {
  std::cerr << start << support::printable(message, kMostMessageBytes) << '\n';
}

/// The innermost subcommand that was named.
const CLI::App& chosen(const CLI::App& app) {
  const auto named = app.get_subcommands();
  return named.empty() ? app : chosen(*named.front());
}

std::vector<std::string> commands_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

std::vector<std::string> options_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

/// What is wrong with words that no command or option takes.
std::string about_unknown(const CLI::App& app) {
  const std::vector<std::string> left = app.remaining(true);
  if (left.empty()) return {};
  const CLI::App& command = chosen(app);
  const std::string word = left.front().substr(0, left.front().find('='));
  const bool takes_command = !commands_of(command).empty();
  if (word.starts_with("-"))
    return "there is no option " + support::quoted(word) +
           support::did_you_mean(word, options_of(command));
  if (!takes_command) return support::quoted(word) + " is one argument too many";
  const std::string nearest = support::did_you_mean(word, commands_of(command));
  return "there is no command " + support::quoted(word) + nearest +
         (nearest.empty() ? "; known: " : " Known: ") + support::listed(commands_of(command));
}

}  // namespace

void print_failure(const std::string& message) {
  print_line("vndf: ", message);
}

void print_warning(const std::string& message) {
  print_line("vndf: warning: ", message);
}

int show(const CLI::App& app, const CLI::ParseError& error) {
  if (error.get_exit_code() == 0) return app.exit(error);
  const std::string unknown = about_unknown(app);
  print_line("", unknown.empty() ? error.what() : unknown);
  std::cerr << "Run with --help for more information.\n";
  return 2;
}

}  // namespace vndf::tools
