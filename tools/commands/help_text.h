// What --help prints. The manual pages are made from it, so that it must read as one.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace vndf::tools {

/// Formats help as manual pages have it: `-o, --output FILE`, and after it what the option does,
/// its default and the options that it cannot be beside.
///
/// The description of a command is one sentence, and below it may be paragraphs, which only its own
/// help has.
class HelpText : public CLI::Formatter {
 public:
  std::string make_description(const CLI::App* app) const override;
  std::string make_subcommand(const CLI::App* sub) const override;
  std::string make_option_name(const CLI::Option* option, bool is_positional) const override;
  std::string make_option_opts(const CLI::Option* option) const override;
  std::string make_option_desc(const CLI::Option* option) const override;
};

}  // namespace vndf::tools
