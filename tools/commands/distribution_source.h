// The slope distribution that a command line asks for: a named one, a formula, a measured profile
// or a map; with what the file is to say of where it came from.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "vndf/distributions/slope_distribution.h"

namespace vndf::tools {

struct SourceArguments {
  std::string spec, p22, ndf, profile, map;  // one of them is given
  std::vector<std::string> parameters;       // NAME=NUMBER of a formula
  std::vector<double> breaks;                // slope radii at which a formula jumps
  std::optional<double> frozen_at;
  std::string tail = "none";
  std::string name;
  bool force = false;
};

struct DistributionSource {
  std::unique_ptr<distributions::SlopeDistribution> distribution;
  /// The options of `vndf build` that give it again.
  std::string options;
  /// CRC-64/XZ of the input file; empty without one.
  std::string input_checksum;
  /// What was found on the way, for people: fits, statistics. One line each.
  std::string notes;
};

/// Adds the options to `command`.
void add_source_options(CLI::App& command, SourceArguments& arguments);

/// The distribution, diagnosed. Throws std::invalid_argument, std::domain_error or
/// std::runtime_error with one clear line, CLI::ValidationError where options do not go together.
DistributionSource make_distribution(const SourceArguments& arguments);

/// The distribution that `vndf build` was told of in `recipe`, its command line. Throws
/// std::runtime_error for any other text, and as make_distribution() does.
DistributionSource distribution_of_recipe(const std::string& recipe);

/// The list of named distributions with their parameters.
std::string list_of_families();

}  // namespace vndf::tools
