// vndf bake: turns the pair of tables into those that a renderer samples from.
#include <fmt/format.h>

#include <chrono>
#include <iostream>
#include <memory>
#include <string>

#include "commands/arguments.h"
#include "commands/bake_options.h"
#include "commands/bake_pair.h"
#include "commands/commands.h"
#include "commands/output_file.h"
#include "commands/table_files.h"
#include "report/report.h"

namespace vndf::tools {
namespace {

struct Arguments {
  std::string input, output;
  BakeArguments baking;
  unsigned threads = 0;
  bool json = false, quiet = false, force = false;
};

void bake_file(const Arguments& a, const std::string& command_line) {
  const auto start = std::chrono::steady_clock::now();
  if (!names_baked_tables(a.output))
    throw std::runtime_error(a.output + ": baked tables are written to a .vndf file; give one");
  require_output(a.output, {a.input}, a.force);
  const KernelTables tables =
      bake_pair(a.input, load_pair(a.input), a.baking, {command_line, a.threads, !a.quiet});
  save(a.output, tables);

  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  if (a.json) {
    auto report = to_json(tables);
    report["output"] = a.output;
    report["seconds"] = seconds.count();
    std::cout << json_text(report) << '\n';
  } else if (!a.quiet) {
    std::cout << describe(tables) << written(a.output, tables.bytes().size(), seconds.count());
  }
}

}  // namespace

void add_bake(CLI::App& app, const std::string& command_line) {
  auto* command = app.add_subcommand(
      "bake",
      "Turn the tables of a file into those that renderers sample from (.vndf)\n\n"
      "Baked tables take 20 to 200 KiB in place of 8 MiB, and are faster to sample. They differ "
      "from "
      "the pair by at most --tolerance. If that takes more than --max-bytes, what could be reached "
      "is "
      "said, and nothing is written.");
  const auto arguments = std::make_shared<Arguments>();
  command->add_option("input", arguments->input, "Table file to read: .h5 or .exr")->required();
  command->add_option("-o,--output", arguments->output, "File to write: .vndf")
      ->type_name("FILE")
      ->required();
  add_bake_options(*command, arguments->baking);
  add_force(*command, arguments->force);
  add_threads(*command, arguments->threads);
  auto* json = command->add_flag("--json", arguments->json, "Print the report as one JSON object");
  command->add_flag("--quiet", arguments->quiet, "Print nothing but warnings")->excludes(json);
  command->callback([arguments, command_line] { bake_file(*arguments, command_line); });
}

}  // namespace vndf::tools
