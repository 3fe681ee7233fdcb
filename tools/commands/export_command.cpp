// vndf export: baked tables with their kernel as a source file of another language, and golden
// vectors for those who port the kernel themselves.
#include <fmt/format.h>

#include <cctype>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "commands/arguments.h"
#include "commands/bake_pair.h"
#include "commands/commands.h"
#include "commands/output_file.h"
#include "commands/table_files.h"
#include "vndf/devices/export_source.h"
#include "vndf/devices/golden_vectors.h"
#include "vndf/support/text.h"

namespace vndf::tools {
namespace {

const std::vector<std::string> kForms{"header", "cuda", "glsl", "hlsl", "metal", "bytes"};
const std::vector<std::pair<std::string, devices::ShadingLanguage>> kShadingLanguages{
    {"glsl", devices::ShadingLanguage::glsl},
    {"hlsl", devices::ShadingLanguage::hlsl},
    {"metal", devices::ShadingLanguage::metal}};

struct Arguments {
  std::string input, output, name, form, place;
  std::uint64_t vectors = 0;
  BakeArguments baking;
  unsigned threads = 0;
  bool quiet = false, force = false;
};

KernelTables baked_tables(const Arguments& a, const std::string& command_line) {
  const AnyTables any = load_tables(a.input);
  const KernelTables* baked = std::get_if<KernelTables>(&any);
  if (!baked)
    return bake_pair(a.input, std::get<io::TableFile>(any), a.baking,
                     {command_line, a.threads, !a.quiet});
  if (a.baking.given())
    throw CLI::ValidationError(
        a.baking.given(),
        "is for a pair, and " + a.input + " is baked already: give the .h5 or .exr file");
  return *baked;
}

/// What the tables are called in the source: --name, or the name of the file without its extension
/// and with underscores for what is no letter and no digit. Throws CLI::ValidationError where that
/// is no name.
std::string name_of(const Arguments& a) {
  if (!a.name.empty()) {
    if (const auto broken = devices::check_name(a.name))
      throw CLI::ValidationError("--name", *broken);
    return a.name;
  }
  std::string name = std::filesystem::path(a.input).stem().string();
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  if (const auto broken = devices::check_name(name))
    throw CLI::ValidationError("--name", "is that of the file if it is not given, and " + *broken);
  return name;
}

std::optional<devices::ShadingLanguage> shading_language(const std::string& form) {
  for (const auto& [name, language] : kShadingLanguages)
    if (name == form) return language;
  return {};
}

bool has_constants(const Arguments& a) {
  return a.place == "constants";
}

std::string shading_source(const Arguments& a, const KernelTables& tables) {
  const auto place =
      has_constants(a) ? devices::TablePlace::constants : devices::TablePlace::buffer;
  return devices::export_shading(tables, *shading_language(a.form), {name_of(a), place});
}

std::string exported(const Arguments& a, const KernelTables& tables) {
  if (a.vectors > 0)
    return devices::golden_csv(tables, devices::golden_vectors(tables.kernel(), a.vectors));
  if (a.form == "bytes")
    return {reinterpret_cast<const char*>(tables.bytes().data()), tables.bytes().size()};
  if (a.form == "header") return devices::export_header(tables, name_of(a));
  if (a.form == "cuda") return devices::export_cuda(tables, name_of(a));
  return shading_source(a, tables);
}

/// What a source that reads the tables from a buffer needs beside it.
std::string advice(const Arguments& a) {
  if (!shading_language(a.form) || has_constants(a)) return {};
  return fmt::format("It reads the tables from a buffer: the bytes of {}.\n",
                     names_baked_tables(a.input) ? support::printable(a.input)
                                                 : "the file that --as bytes writes");
}

void require_usage(const Arguments& a) {
  if (a.form.empty() && a.vectors == 0)
    throw CLI::ValidationError("--as", "says what to write; give it, or --vectors");
  if (!a.place.empty() && !shading_language(a.form))
    throw CLI::ValidationError("--tables", "is for glsl, hlsl and metal: leave it out");
  const bool is_source = !a.form.empty() && a.form != "bytes";
  if (!a.name.empty() && !is_source)
    throw CLI::ValidationError("--name", "is for sources: leave it out");
  if (is_source) name_of(a);  // before a pair is baked, which takes long
}

void export_tables(const Arguments& a, const std::string& command_line) {
  require_usage(a);
  require_output(a.output, {a.input}, a.force);
  const KernelTables tables = baked_tables(a, command_line);
  const std::string text = exported(a, tables);
  write_file(a.output, text);
  if (!a.quiet)
    std::cout << fmt::format("wrote {}, {} bytes\n", support::printable(a.output), text.size())
              << advice(a);
}

}  // namespace

void add_export(CLI::App& app, const std::string& command_line) {
  auto* command = app.add_subcommand(
      "export", "Write tables and kernel as source for another language or device");
  const auto a = std::make_shared<Arguments>();
  command
      ->add_option("input", a->input, "Table file to read: .vndf, or .h5 or .exr, which are baked")
      ->required();
  command->add_option("-o,--output", a->output, "File to write")->required();
  auto* form =
      command
          ->add_option("--as", a->form,
                       "What to write: header (C++17), cuda, glsl, hlsl, metal, or bytes (.vndf)")
          ->check(CLI::IsMember(kForms));
  command->add_option("--vectors", a->vectors, "Write this many golden vectors instead, as CSV")
      ->check(whole_number(1, 1000000))
      ->excludes(form);
  command->add_option("--name", a->name, "Of the tables in the source; that of the file");
  command
      ->add_option("--tables", a->place,
                   "Where glsl, hlsl and metal have the tables: buffer, or constants, for the "
                   "smallest tables (default buffer)")
      ->check(CLI::IsMember({"buffer", "constants"}));
  add_bake_options(*command, a->baking);
  add_force(*command, a->force);
  add_threads(*command, a->threads);
  command->add_flag("--quiet", a->quiet, "Print nothing but warnings");
  command->callback([a, command_line] { export_tables(*a, command_line); });
}

}  // namespace vndf::tools
