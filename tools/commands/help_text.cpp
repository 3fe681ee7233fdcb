// Help in the form of manual pages.
#include "commands/help_text.h"

#include <regex>
#include <sstream>

namespace vndf::tools {
namespace {

/// An option that excludes more than these, such as --list, stands alone; that it excludes the
/// others is in its description, and need not be in theirs.
constexpr std::size_t kMostExcluded = 5;

bool stands_alone(const CLI::Option& option) {
  return option.get_excludes().size() > kMostExcluded;
}

/// The word for a value: what a rule says of it, as in "TEXT:{single,double}", or its type. CLI11
/// writes a choice with what stands for it in the program, as in "{single->0,double->1}".
std::string value_word(const std::string& type) {
  const auto colon = type.find(':');
  const std::string word = type.substr(colon == std::string::npos ? 0 : colon + 1);
  if (word == "FLOAT" || word == "UINT" || word == "INT") return "NUMBER";
  return std::regex_replace(word, std::regex("->[^,}]*"), "");
}

/// CLI11 has lists in brackets.
std::string without_brackets(const std::string& list) {
  return list.starts_with('[') ? list.substr(1, list.size() - 2) : list;
}

std::string excluded_by(const CLI::Option& option) {
  std::string names;
  if (stands_alone(option)) return names;
  for (const CLI::Option* other : option.get_excludes())
    if (!stands_alone(*other)) names += (names.empty() ? "" : ", ") + other->get_name();
  return names;
}

}  // namespace

std::string HelpText::make_description(const CLI::App* app) const {
  return app->get_description() + "\n\n";
}

std::string HelpText::make_subcommand(const CLI::App* sub) const {
  std::ostringstream out;
  const std::string description = sub->get_description();
  CLI::detail::format_help(out, sub->get_name(), description.substr(0, description.find('\n')),
                           get_column_width());
  return out.str();
}

std::string HelpText::make_option_name(const CLI::Option* option, bool is_positional) const {
  const std::string name = option->get_name(is_positional, !is_positional);
  const auto comma = name.find(',');
  return comma == std::string::npos ? name : name.substr(0, comma) + ", " + name.substr(comma + 1);
}

std::string HelpText::make_option_opts(const CLI::Option* option) const {
  // The blank at the end keeps two blanks before the description, which help2man wants.
  if (option->get_positional() || option->get_type_size() == 0) return " ";
  const bool many = option->get_expected_max() == CLI::detail::expected_max_vector_size;
  return " " + value_word(option->get_type_name()) + (many ? " ... " : " ");
}

std::string HelpText::make_option_desc(const CLI::Option* option) const {
  std::string text = option->get_description();
  const std::string value = without_brackets(option->get_default_str());
  const std::string excluded = excluded_by(*option);
  if (!value.empty()) text += " (default " + value + ")";
  if (option->get_required() && !option->get_positional()) text += " (required)";
  if (!excluded.empty()) text += "; not with " + excluded;
  return text;
}

}  // namespace vndf::tools
