// vndf build: a distribution becomes a table file with its certificate.
#include <fmt/format.h>
#include <unistd.h>

#include <charconv>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>

#include "commands.h"
#include "io/table_file.h"
#include "precompute/build_tables.h"
#include "precompute/named_distribution.h"
#include "report.h"

namespace vndf::tools {
namespace {

struct Size {
  std::size_t rows, columns;
};

struct BuildArguments {
  std::string distribution, output, size = "1024";
  unsigned threads = 0;
  bool json = false, quiet = false;
};

bool parse_number(std::string_view text, std::size_t& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

/// "N" or "NTHETAxNU"; the limits are the builder's to judge.
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

/// A bar on standard error, drawn only where a person sees it.
std::function<void(double)> progress_bar(const BuildArguments& arguments) {
  if (arguments.quiet || isatty(STDERR_FILENO) == 0) return {};
  return [last = -1](double fraction) mutable {
    constexpr int kWidth = 40;
    const int full = static_cast<int>(fraction * kWidth);
    if (full == last) return;
    last = full;
    std::cerr << fmt::format("\r[{:<{}}] {:3.0f} %",
                             std::string(static_cast<std::size_t>(full), '#'), kWidth,
                             100 * fraction);
    if (full == kWidth) std::cerr << '\n';
    std::cerr.flush();
  };
}

std::string recipe(const BuildArguments& arguments, const Size& size) {
  return fmt::format("vndf build {} --size {}x{} -o {}", arguments.distribution, size.rows,
                     size.columns, std::filesystem::path(arguments.output).filename().string());
}

void build(const BuildArguments& arguments) {
  const auto start = std::chrono::steady_clock::now();
  io::format_for(arguments.output);  // refuses an unknown extension before any work
  const auto distribution = precompute::named_distribution(arguments.distribution);
  Size size{};
  parse_size(arguments.size, size);
  const auto built = precompute::build_tables(
      *distribution, {size.rows, size.columns, arguments.threads, progress_bar(arguments)});
  const io::TableFile file{built.tables, {recipe(arguments, size), kProgram}, built.certificate};
  io::save(arguments.output, file);

  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  const auto bytes = std::filesystem::file_size(arguments.output);
  if (arguments.json) {
    auto report = to_json(file);
    report["output"] = arguments.output;
    report["seconds"] = seconds.count();
    report["bytes"] = bytes;
    report["mass"] = built.mass;
    report["quadrature_error"] = built.quadrature_error;
    std::cout << report.dump(2) << '\n';
  } else if (!arguments.quiet) {
    std::cout << describe(file)
              << fmt::format("\nwrote {} ({:.1f} MiB) in {:.2f} s\n", arguments.output,
                             static_cast<double>(bytes) / (1 << 20), seconds.count());
  }
}

}  // namespace

void add_build(CLI::App& app) {
  auto* command = app.add_subcommand("build", "Build the tables of a slope distribution");
  const auto arguments = std::make_shared<BuildArguments>();
  std::string names;
  for (const auto& name : precompute::distribution_names())
    names += (names.empty() ? "" : ", ") + name;
  command->add_option("distribution", arguments->distribution, "One of: " + names)->required();
  command
      ->add_option("-o,--output", arguments->output, "File to write: .h5 (HDF5) or .exr (OpenEXR)")
      ->required();
  command->add_option("--size", arguments->size, "Nodes per axis, N or NTHETAxNU, of both tables")
      ->capture_default_str()
      ->check(CLI::Validator(size_rule, "N|NTHETAxNU"));
  command->add_option("--threads", arguments->threads, "Threads; 0 for one per processor")
      ->capture_default_str();
  command->add_flag("--json", arguments->json, "Print the report as one JSON object");
  command->add_flag("--quiet", arguments->quiet, "Print nothing, draw no progress bar");
  command->callback([arguments] { build(*arguments); });
}

}  // namespace vndf::tools
