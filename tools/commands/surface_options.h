// The options of a surface: how its slopes are correlated, tilted or turned. Commands that draw or
// judge samples share them.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "vndf/surface_slopes.h"

namespace vndf::tools {

struct SurfaceArguments {
  double correlation = 0;
  std::vector<double> mean{0, 0};  // slopes along x and y
  double degrees = 0;              // by which the roughness is turned
  bool as_mapped = false;          // the surface that the tables record
};

/// Adds --correlation, --mean, --rotate and --as-mapped. The last excludes the others, and --alpha
/// if the command has it already.
void add_surface_options(CLI::App& command, SurfaceArguments& arguments);

/// The surface that the options describe at roughness `alpha`, which --as-mapped does not use.
/// `recorded` is that of the tables in `file`. Throws CLI::ValidationError for options that make no
/// surface, and std::runtime_error, which names the file, for --as-mapped where none is recorded.
SurfaceSlopes surface_of(const SurfaceArguments& arguments, const Alpha<double>& alpha,
                         const std::string& file, const std::optional<SurfaceSlopes>& recorded);

}  // namespace vndf::tools
