// The commands that render, in a program that was built without the path tracer.
#include <stdexcept>
#include <string>

#include "commands/commands.h"

namespace vndf::tools {
namespace {

void add_unavailable(CLI::App& app, const std::string& name) {
  auto* command = app.add_subcommand(name, "Render scenes (not in this program: no Embree)");
  command->allow_extras();
  command->callback([name] {
    throw std::runtime_error(
        name +
        ": this program was built without Embree; install it (on Debian, libembree-dev), then "
        "configure and build the program again");
  });
}

}  // namespace

void add_render(CLI::App& app) {
  add_unavailable(app, "render");
}

void add_scenes_experiment(CLI::App& experiments) {
  add_unavailable(experiments, "scenes");
}

}  // namespace vndf::tools
