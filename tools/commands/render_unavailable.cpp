// vndf render in a program that was built without the path tracer.
#include <stdexcept>

#include "commands/commands.h"

namespace vndf::tools {

void add_render(CLI::App& app) {
  auto* command = app.add_subcommand("render", "Render a scene (not in this program: no Embree)");
  command->allow_extras();
  command->callback([] {
    throw std::runtime_error(
        "render: this program was built without Embree; install it (on Debian, libembree-dev), "
        "then "
        "configure and build the program again");
  });
}

}  // namespace vndf::tools
