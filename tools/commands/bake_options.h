// The options of baking, which `vndf bake` and `vndf build` share.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>

#include "vndf/baking/bake.h"

namespace vndf::tools {

struct BakeArguments {
  std::optional<double> tolerance;
  std::optional<std::uint64_t> max_bytes;
  bool above_only = false;

  /// The first of the options that was given, or nothing.
  const char* given() const {
    return tolerance    ? "--tolerance"
           : max_bytes  ? "--max-bytes"
           : above_only ? "--above-only"
                        : nullptr;
  }
};

/// Adds --tolerance, --max-bytes and --above-only.
void add_bake_options(CLI::App& command, BakeArguments& arguments);

/// What is asked for, with the defaults of BakeOptions.
BakeOptions options_of(const BakeArguments& arguments);

/// Throws CLI::ValidationError if an option of baking is given where `output` is a pair of tables.
void require_baked_output(const BakeArguments& arguments, const std::string& output);

}  // namespace vndf::tools
