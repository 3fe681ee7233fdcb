// The subcommands of the program. Each adds its options to `app` and what to do when it is chosen;
// a failure is thrown as an exception whose message is one clear line.
#pragma once

#include <CLI/CLI.hpp>

namespace vndf::tools {

/// Name and version, as written into files.
inline constexpr const char* kProgram = "vndf " VNDF_VERSION;

void add_build(CLI::App& app);
void add_bake(CLI::App& app);
void add_info(CLI::App& app);
void add_sample(CLI::App& app);
void add_convert(CLI::App& app);
void add_picture(CLI::App& app);
void add_experiment(CLI::App& app);
void add_validate(CLI::App& app);
void add_check(CLI::App& app);
void add_bench(CLI::App& app);

}  // namespace vndf::tools
