// The vndf program: parses the command line, calls the library, prints. Exit status 0, 1 after a
// failure (one line on standard error) or a sampler that does not pass, and 2 for wrong usage.
#include <exception>
#include <memory>
#include <string>

#include "commands/command_line.h"
#include "commands/commands.h"
#include "commands/help_text.h"
#include "commands/messages.h"
#include "commands/output_file.h"

int main(int argc, char** argv) {
  CLI::App app{
      "Tables for sampling the visible normals of any slope distribution.\n"
      "Build them once, load them in a renderer, sample at any roughness and incidence.\n"
      "`vndf COMMAND --help` and the page vndf-COMMAND(1) explain each command.",
      "vndf"};
  app.formatter(std::make_shared<vndf::tools::HelpText>());
  app.set_version_flag("--version", vndf::tools::kProgram);
  app.require_subcommand(1);
  app.fallthrough(false);
  const std::string line = vndf::tools::command_line(argc, argv);
  vndf::tools::add_build(app, line);
  vndf::tools::add_bake(app, line);
  vndf::tools::add_export(app, line);
  vndf::tools::add_info(app);
  vndf::tools::add_sample(app);
  vndf::tools::add_convert(app);
  vndf::tools::add_picture(app);
  vndf::tools::add_render(app);
  vndf::tools::add_experiment(app);
  vndf::tools::add_validate(app);
  vndf::tools::add_check(app);
  vndf::tools::add_bench(app);
  try {
    app.parse(argc, argv);
    vndf::tools::require_printed();
  } catch (const CLI::RuntimeError& e) {
    return e.get_exit_code();  // a verdict, already printed
  } catch (const CLI::ParseError& e) {
    return vndf::tools::show(app, e);
  } catch (const std::exception& e) {
    vndf::tools::print_failure(e.what());
    return 1;
  }
  return 0;
}
