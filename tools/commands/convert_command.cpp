// vndf convert: the same tables in the other format.
#include <memory>
#include <stdexcept>
#include <string>

#include "commands/commands.h"
#include "commands/output_file.h"
#include "commands/table_files.h"

namespace vndf::tools {
namespace {

void save_pair(const std::string& input, const io::TableFile& pair, const std::string& output) {
  if (names_baked_tables(output))
    throw std::runtime_error(
        output +
        ": converting keeps all bits of a pair, and baked tables hold others; use 'vndf bake " +
        input + " -o " + output + "'");
  io::save(output, pair);
}

void save_baked(const std::string& input, const KernelTables& tables, const std::string& output) {
  if (!names_baked_tables(output))
    throw std::runtime_error(input +
                             ": baked tables do not hold the pair that they were baked from; give "
                             "the pair, a .h5 or .exr file");
  save(output, tables);
}

void convert(const std::string& input, const std::string& output, bool force) {
  if (!names_baked_tables(output)) io::format_for(output);
  require_output(output, {input}, force);
  const AnyTables tables = load_tables(input);
  if (const auto* pair = std::get_if<io::TableFile>(&tables))
    save_pair(input, *pair, output);
  else
    save_baked(input, std::get<KernelTables>(tables), output);
}

}  // namespace

void add_convert(CLI::App& app) {
  struct Arguments {
    std::string input, output;
    bool force = false;
  };
  auto* command = app.add_subcommand(
      "convert",
      "Copy tables to another format, bit for bit\n\n"
      "The endings of the names choose the formats: HDF5 (.h5) and OpenEXR (.exr) of a pair.");
  const auto arguments = std::make_shared<Arguments>();
  command->add_option("input", arguments->input, "Table file to read")->required();
  command
      ->add_option("output", arguments->output,
                   "Table file to write: .h5 or .exr, or .vndf from .vndf")
      ->required();
  add_force(*command, arguments->force);
  command->callback(
      [arguments] { convert(arguments->input, arguments->output, arguments->force); });
}

}  // namespace vndf::tools
