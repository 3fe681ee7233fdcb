// vndf build: a distribution becomes a table file with its certificate.
#include <fmt/format.h>

#include <charconv>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>

#include "commands/arguments.h"
#include "commands/bake_options.h"
#include "commands/commands.h"
#include "commands/distribution_source.h"
#include "commands/messages.h"
#include "commands/output_file.h"
#include "commands/progress.h"
#include "commands/table_files.h"
#include "report/report.h"
#include "vndf/precompute/bake_certified.h"
#include "vndf/precompute/build_tables.h"

namespace vndf::tools {
namespace {

struct Size {
  std::size_t rows, columns;
};

struct BuildArguments {
  SourceArguments source;
  BakeArguments baking;
  std::string output, size = "1024", precision = "single";
  unsigned threads = 0;
  bool json = false, quiet = false, list = false, force = false;
};

bool parse_number(std::string_view text, std::size_t& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

/// "N" or "NTHETAxNU"; the builder checks its limits.
bool parse_size(const std::string& text, Size& size) {
  const auto x = text.find('x');
  if (x == std::string::npos) {
    size.columns = 0;
    const bool ok = parse_number(text, size.rows);
    size.columns = size.rows;
    return ok;
  }
  const std::string_view view = text;
  return parse_number(view.substr(0, x), size.rows) &&
         parse_number(view.substr(x + 1), size.columns);
}

std::string size_rule(const std::string& text) {
  Size size{};
  return parse_size(text, size) ? "" : "'" + text + "' is not a size: give N or NTHETAxNU";
}

/// Tables are written whatever they err by, but not in silence.
void warn_of_errors(const Certificate& certificate) {
  constexpr double kLarge = 1e-3;
  const auto warn = [](const TableErrors& e, const char* table, const char* row) {
    if (e.max_u_error <= kLarge) return;
    print_warning(fmt::format(
        "the {} errs by up to {:.2e} in u (at {} {:.4g}, u {:.6g}); a larger --size may help",
        table, e.max_u_error, row, e.worst_row, e.worst_u));
  };
  warn(certificate.marginal, "marginal table", "theta");
  warn(certificate.below, "marginal table below the horizon", "theta");
  warn(certificate.conditional, "conditional table", "slope");
}

/// Returns what is written: the pair, or the tables baked from it.
AnyTables tables_of(const BuildArguments& arguments, const Provenance& provenance,
                    const distributions::SlopeDistribution& distribution,
                    const precompute::BuiltTables& built, Progress& progress) {
  if (!names_baked_tables(arguments.output))
    return io::TableFile{built.tables, provenance, built.certificate};
  progress.begin("baking");
  const support::Workers workers = progress.workers(arguments.threads);
  return precompute::bake_certified(precompute::UnitSlopes(distribution, workers), *built.tables,
                                    options_of(arguments.baking),
                                    {built.tables->distribution, provenance}, workers);
}

void save_as(const std::string& output, const io::TableFile& pair) {
  io::save(output, pair);
}
void save_as(const std::string& output, const KernelTables& tables) {
  save(output, tables);
}
const Certificate& certificate_of(const io::TableFile& pair) {
  return pair.certificate;
}
Certificate certificate_of(const KernelTables& tables) {
  return tables.certificate();
}

void build(const BuildArguments& arguments, const std::string& command_line) {
  const auto start = std::chrono::steady_clock::now();
  // A file that cannot be written is refused before any work.
  if (!names_baked_tables(arguments.output)) io::format_for(arguments.output);
  require_baked_output(arguments.baking, arguments.output);
  require_output(arguments.output, {arguments.source.profile, arguments.source.map},
                 arguments.force);
  const auto source = source_of(arguments.source);
  const auto distribution = make_distribution(source);
  Size size{};
  parse_size(arguments.size, size);
  Progress progress(!arguments.quiet);
  progress.begin("building");
  const auto built = precompute::build_tables(
      *distribution, {.layout = {size.rows, size.columns, arguments.precision == "double"},
                      .threads = arguments.threads,
                      .progress = [&](double fraction) { progress.show(fraction); }});
  const auto finish = [&](const auto& tables) {
    progress.erase();
    warn_of_errors(certificate_of(tables));
    save_as(arguments.output, tables);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    const auto bytes = std::filesystem::file_size(arguments.output);
    if (arguments.json) {
      auto report = to_json(tables);
      report["output"] = arguments.output;
      report["seconds"] = seconds.count();
      report["bytes"] = bytes;
      report["mass"] = built.mass;
      report["quadrature_error"] = built.quadrature_error;
      std::cout << json_text(report) << '\n';
    } else if (!arguments.quiet) {
      std::cout << describe(tables) << written(arguments.output, bytes, seconds.count());
    }
  };
  const Provenance provenance{source.specification, command_line, kProgram, source.notes,
                              source.surface};
  std::visit(finish, tables_of(arguments, provenance, *distribution, built, progress));
}

}  // namespace

void add_build(CLI::App& app, const std::string& command_line) {
  auto* command = app.add_subcommand("build",
                                     "Build the tables of a slope distribution\n\n"
                                     "The distribution has a name, or it is given as a formula, as "
                                     "a measured profile or as a normal "
                                     "map. The ending of the output's name chooses what is "
                                     "written: the pair of tables (.h5, .exr), "
                                     "or tables baked from it, from which renderers sample "
                                     "(.vndf). Their errors are measured, and "
                                     "are stored with them.");
  const auto arguments = std::make_shared<BuildArguments>();
  add_source_options(*command, arguments->source);
  command
      ->add_option("-o,--output", arguments->output,
                   "File to write: .h5 (HDF5) or .exr (OpenEXR), or .vndf (baked, for renderers)")
      ->type_name("FILE");
  command->add_option("--size", arguments->size, "Nodes per axis, N or NTHETAxNU, of both tables")
      ->capture_default_str()
      ->check(CLI::Validator(size_rule, "N|NTHETAxNU"));
  command->add_option("--precision", arguments->precision, "Precision of the stored values")
      ->check(CLI::IsMember({"single", "double"}))
      ->capture_default_str();
  add_bake_options(*command, arguments->baking);
  add_force(*command, arguments->force);
  add_threads(*command, arguments->threads);
  auto* json = command->add_flag("--json", arguments->json, "Print the report as one JSON object");
  command->add_flag("--quiet", arguments->quiet, "Print nothing but warnings")->excludes(json);
  exclude_others(*command, command->add_flag("--list", arguments->list,
                                             "List the named distributions and stop"));
  command->callback([arguments, command_line] {
    if (arguments->list) {
      std::cout << list_of_families();
      return;
    }
    if (arguments->output.empty()) throw CLI::RequiredError("--output");
    build(*arguments, command_line);
  });
}

}  // namespace vndf::tools
