// The slope distribution that a command line asks for: a named one, a formula, a measured profile
// or a map.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "vndf/distributions/slope_distribution.h"
#include "vndf/provenance.h"

namespace vndf::tools {

struct SourceArguments {
  std::string spec, p22, ndf, profile, map;  // exactly one of them is given
  std::vector<std::string> parameters;       // NAME=NUMBER of a formula
  std::vector<double> breaks;                // slope radii at which a formula jumps
  std::optional<double> frozen_at;
  std::optional<std::string> tail;  // of a profile; none if it is not given
  std::string name;
  bool smooth = false;                  // a profile
  std::optional<std::string> encoding;  // of a map; automatic if it is not given
  bool ignore_asymmetry = false;        // of a map
};

struct DistributionSource {
  Specification specification;
  /// What was found on the way, for people: fits and statistics, one line each.
  std::string notes = {};
  /// That of a map.
  std::optional<SurfaceSlopes> surface = {};
};

/// Adds the options to `command`.
void add_source_options(CLI::App& command, SourceArguments& arguments);

/// Reads the file that the options name, if any, and specifies the distribution. Throws
/// CLI::ValidationError where options do not go together, and std::invalid_argument,
/// std::domain_error or std::runtime_error, one clear line, for a wrong name, formula or file.
DistributionSource source_of(const SourceArguments& arguments);

/// Makes the distribution. Throws as distributions::make_distribution() does, with the option that
/// helps named where there is one.
std::unique_ptr<distributions::SlopeDistribution> make_distribution(
    const DistributionSource& source);

/// The list of named distributions with their parameters.
std::string list_of_families();

}  // namespace vndf::tools
