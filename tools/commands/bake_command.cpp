// vndf bake: the pair of tables becomes those that a kernel samples from.
#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>

#include "commands/arguments.h"
#include "commands/bake_options.h"
#include "commands/commands.h"
#include "commands/output_file.h"
#include "commands/table_files.h"
#include "commands/verdicts.h"
#include "report/report.h"
#include "vndf/precompute/bake_certified.h"

namespace vndf::tools {
namespace {

struct Arguments {
  std::string input, output;
  BakeArguments baking;
  unsigned threads = 0;
  bool json = false, quiet = false;
};

std::string file_name(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

KernelText text_of(const io::TableFile& pair, const Arguments& a) {
  const std::string options = recipe_options(options_of(a.baking));
  return {.distribution = pair.tables->distribution,
          .recipe = build_recipe(pair.provenance.recipe, a.output, options)
                        .value_or("vndf bake " + file_name(a.input) + options + " -o " +
                                  file_name(a.output)),
          .program = kProgram,
          .input_checksum = pair.provenance.input_checksum,
          .notes = pair.provenance.notes};
}

/// With the certificate that is measured against the exact law, or, where that cannot be had again,
/// one that follows from the pair's.
KernelTables baked(const io::TableFile& pair, const Arguments& a) {
  const BakeOptions options = options_of(a.baking);
  KernelText text = text_of(pair, a);
  std::unique_ptr<distributions::SlopeDistribution> distribution;
  try {
    distribution = distribution_of(pair.provenance.recipe, pair.provenance.input_checksum);
  } catch (const std::exception& e) {
    const std::string note = fmt::format(
        "certificate: that of the pair and the differences from it, not measured, for {}",
        e.what());
    if (!a.quiet) std::cerr << "vndf: warning: " << note << '\n';
    text.notes += note + "\n";
    return precompute::bake_uncertified(*pair.tables, pair.certificate, options, text);
  }
  const support::Workers workers{a.threads};
  return precompute::bake_certified(precompute::UnitSlopes(*distribution, workers), *pair.tables,
                                    options, text, workers);
}

void bake_file(const Arguments& a) {
  const auto start = std::chrono::steady_clock::now();
  if (!names_baked_tables(a.output))
    throw std::runtime_error(a.output + ": baked tables are written to a .vndf file; give one");
  require_output(a.output, {a.input});
  const KernelTables tables = baked(load_pair(a.input), a);
  save(a.output, tables);

  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  if (a.json) {
    auto report = to_json(tables);
    report["output"] = a.output;
    report["seconds"] = seconds.count();
    std::cout << report.dump(2) << '\n';
  } else if (!a.quiet) {
    std::cout << describe(tables) << written(a.output, tables.bytes().size(), seconds.count());
  }
}

}  // namespace

void add_bake(CLI::App& app) {
  auto* command = app.add_subcommand(
      "bake", "Turn the tables of a file into those that renderers sample from (.vndf)");
  const auto arguments = std::make_shared<Arguments>();
  command->add_option("input", arguments->input, "Table file to read: .h5 or .exr")->required();
  command->add_option("-o,--output", arguments->output, "File to write: .vndf")->required();
  add_bake_options(*command, arguments->baking);
  add_threads(*command, arguments->threads);
  auto* json = command->add_flag("--json", arguments->json, "Print the report as one JSON object");
  command->add_flag("--quiet", arguments->quiet, "Print nothing")->excludes(json);
  command->callback([arguments] { bake_file(*arguments); });
}

}  // namespace vndf::tools
