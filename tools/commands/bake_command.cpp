// vndf bake: turns the pair of tables into those that a renderer samples from.
#include <fmt/format.h>

#include <chrono>
#include <iostream>
#include <memory>
#include <string>

#include "commands/arguments.h"
#include "commands/bake_options.h"
#include "commands/commands.h"
#include "commands/messages.h"
#include "commands/output_file.h"
#include "commands/progress.h"
#include "commands/table_files.h"
#include "report/report.h"
#include "vndf/precompute/bake_certified.h"

namespace vndf::tools {
namespace {

struct Arguments {
  std::string input, output;
  BakeArguments baking;
  unsigned threads = 0;
  bool json = false, quiet = false, force = false;
};

/// Bakes with a certificate that is measured against the distribution. Where that cannot be made
/// again, the certificate follows from the pair's.
KernelTables baked(const io::TableFile& pair, const Arguments& a, const std::string& command_line) {
  const BakeOptions options = options_of(a.baking);
  KernelText text{pair.tables->distribution, pair.provenance};
  text.provenance.command += "\n" + command_line;
  text.provenance.program = kProgram;
  std::unique_ptr<distributions::SlopeDistribution> distribution;
  try {
    distribution = distribution_of(a.input, pair);
  } catch (const std::exception& e) {
    const std::string note = fmt::format(
        "certificate: that of the pair and the differences from it, not measured, for {}",
        e.what());
    print_warning(note);
    text.provenance.notes += note + "\n";
    return precompute::bake_uncertified(*pair.tables, pair.certificate, options, text);
  }
  Progress progress(!a.quiet);
  progress.begin("baking");
  const support::Workers workers = progress.workers(a.threads);
  return precompute::bake_certified(precompute::UnitSlopes(*distribution, workers), *pair.tables,
                                    options, text, workers);
}

void bake_file(const Arguments& a, const std::string& command_line) {
  const auto start = std::chrono::steady_clock::now();
  if (!names_baked_tables(a.output))
    throw std::runtime_error(a.output + ": baked tables are written to a .vndf file; give one");
  require_output(a.output, {a.input}, a.force);
  const KernelTables tables = baked(load_pair(a.input), a, command_line);
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
      "bake", "Turn the tables of a file into those that renderers sample from (.vndf)");
  const auto arguments = std::make_shared<Arguments>();
  command->add_option("input", arguments->input, "Table file to read: .h5 or .exr")->required();
  command->add_option("-o,--output", arguments->output, "File to write: .vndf")->required();
  add_bake_options(*command, arguments->baking);
  add_force(*command, arguments->force);
  add_threads(*command, arguments->threads);
  auto* json = command->add_flag("--json", arguments->json, "Print the report as one JSON object");
  command->add_flag("--quiet", arguments->quiet, "Print nothing but warnings")->excludes(json);
  command->callback([arguments, command_line] { bake_file(*arguments, command_line); });
}

}  // namespace vndf::tools
