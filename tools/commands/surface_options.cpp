// From options to a surface.
#include "commands/surface_options.h"

#include <stdexcept>

#include "commands/arguments.h"

namespace vndf::tools {

void add_surface_options(CLI::App& command, SurfaceArguments& a) {
  const std::string group = "The surface";
  auto* correlation = command
                          .add_option("--correlation", a.correlation,
                                      "Correlation of the slopes along x and y, inside (-1, 1)")
                          ->check(number_inside(-1, 1))
                          ->group(group);
  auto* mean =
      command
          .add_option("--mean", a.mean, "Mean slope along x and y: that of the facet (-X, -Y, 1)")
          ->delimiter(',')
          ->expected(2)
          ->type_name("X,Y")
          ->check(finite_number())
          ->group(group);
  auto* rotate = command
                     .add_option("--rotate", a.degrees,
                                 "Degrees by which the roughness is turned from x towards y; the "
                                 "mean slope is not")
                     ->check(finite_number())
                     ->group(group)
                     ->excludes(correlation);
  auto* as_mapped = command
                        .add_flag("--as-mapped", a.as_mapped,
                                  "The surface of the map that the tables were made from")
                        ->group(group);
  for (auto* option : {correlation, mean, rotate}) as_mapped->excludes(option);
  if (auto* alpha = command.get_option_no_throw("--alpha")) as_mapped->excludes(alpha);
}

SurfaceSlopes surface_of(const SurfaceArguments& a, const Alpha<double>& alpha,
                         const std::string& file, const std::optional<SurfaceSlopes>& recorded) {
  if (a.as_mapped) {
    if (recorded) return *recorded;
    throw std::runtime_error(file +
                             ": it records no surface, because it was not made from a map; give "
                             "--alpha, --correlation and --mean in place of --as-mapped");
  }
  SurfaceSlopes slopes = turned(alpha, a.degrees);
  if (a.degrees == 0) slopes.correlation = a.correlation;
  slopes.mean = {a.mean[0], a.mean[1]};
  if (const auto broken = check(slopes)) throw CLI::ValidationError("the surface", *broken);
  return slopes;
}

}  // namespace vndf::tools
