// The subcommands of the program. Each function adds a subcommand to `app`, with its options and
// what to do when it is chosen. A failure is thrown as an exception whose message is one clear
// line.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "vndf/version.h"

namespace vndf::tools {

/// Name and version, as written into files.
inline constexpr const char* kProgram = "vndf " VNDF_VERSION;

/// `command_line` is written into the files, for people.
void add_build(CLI::App& app, const std::string& command_line);
void add_bake(CLI::App& app, const std::string& command_line);
void add_export(CLI::App& app, const std::string& command_line);
void add_info(CLI::App& app);
void add_sample(CLI::App& app);
void add_convert(CLI::App& app);
void add_picture(CLI::App& app);
void add_experiment(CLI::App& app);
/// Without Embree, the command says what to install.
void add_render(CLI::App& app);
/// Adds to the experiments. Without Embree, the command says what to install.
void add_scenes_experiment(CLI::App& experiments);
void add_validate(CLI::App& app);
void add_check(CLI::App& app);
void add_bench(CLI::App& app);

}  // namespace vndf::tools
