// Files of tables of either kind: the pair (.h5, .exr), and those that a kernel samples from
// (.vndf), which are baked from it.
#pragma once

#include <optional>
#include <string>
#include <variant>

#include "vndf/io/table_file.h"
#include "vndf/kernel_tables.h"

namespace vndf::tools {

using AnyTables = std::variant<io::TableFile, KernelTables>;

/// Whether the name is that of a file of baked tables: .vndf in either case.
bool names_baked_tables(const std::string& path);

/// The tables of a file of either kind. Throws what the readers throw, naming the file.
AnyTables load_tables(const std::string& path);

/// The pair. Throws std::runtime_error, saying how to get it, for baked tables.
io::TableFile load_pair(const std::string& path);

/// The command that builds what `recipe` does into another file, with these options of baking, for
/// baked tables are made again by building the pair and baking it in one go. Nothing where `recipe`
/// is no command line of vndf build.
std::optional<std::string> build_recipe(const std::string& recipe, const std::string& output,
                                        const std::string& bake_options = {});

/// The same of the pair for messages: ", made by 'RECIPE'", or nothing.
std::string made_by(const std::string& recipe, const std::string& output);

}  // namespace vndf::tools
