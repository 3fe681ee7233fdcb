// The options of baking, which `build` and `bake` share.
#include "commands/bake_options.h"

#include <fmt/format.h>

#include "commands/arguments.h"
#include "commands/table_files.h"

namespace vndf::tools {
namespace {

CLI::Validator tolerance_rule() {
  const auto positive = positive_number();
  const auto rule = [positive](std::string text) -> std::string {
    const std::string broken = positive(text);
    if (!broken.empty()) return broken;
    const double value = std::stod(text);
    if (value >= kLeastTolerance && value <= kMostTolerance) return {};
    return fmt::format("'{}' is not a number from {} to {}", text, kLeastTolerance, kMostTolerance);
  };
  return {rule, ""};
}

}  // namespace

void add_bake_options(CLI::App& command, BakeArguments& arguments) {
  const BakeOptions defaults;
  command
      .add_option(
          "--tolerance", arguments.tolerance,
          fmt::format(
              "Of baked tables (.vndf): largest difference from the pair, in u (default {})",
              defaults.tolerance))
      ->check(tolerance_rule());
  command
      .add_option(
          "--max-bytes", arguments.max_bytes,
          fmt::format("Of baked tables (.vndf): most bytes that sampling reads (default {})",
                      defaults.max_bytes))
      ->check(whole_number(1));
  command.add_flag(
      "--above-only", arguments.above_only,
      "Of baked tables (.vndf): leave out what only directions below the horizon need");
}

BakeOptions options_of(const BakeArguments& arguments) {
  BakeOptions options;
  options.tolerance = arguments.tolerance.value_or(options.tolerance);
  options.max_bytes = arguments.max_bytes.value_or(options.max_bytes);
  options.below_horizon = !arguments.above_only;
  return options;
}

void require_baked_output(const BakeArguments& arguments, const std::string& output) {
  if (names_baked_tables(output) || !arguments.given()) return;
  throw CLI::ValidationError(arguments.given(), "is for baked tables, and " + output +
                                                    " is a pair: give a .vndf file to write");
}

}  // namespace vndf::tools
