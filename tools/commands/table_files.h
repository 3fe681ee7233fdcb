// Files of tables of either kind: the pair (.h5, .exr), and the baked tables that a renderer
// samples from (.vndf).
#pragma once

#include <memory>
#include <string>
#include <variant>

#include "vndf/distributions/slope_distribution.h"
#include "vndf/io/table_file.h"
#include "vndf/kernel_tables.h"

namespace vndf::tools {

using AnyTables = std::variant<io::TableFile, KernelTables>;

/// Returns the extension of a name in lower case, with its dot.
std::string extension_of(const std::string& path);

/// Returns true if the name is that of a file of baked tables: .vndf in either case.
bool names_baked_tables(const std::string& path);

/// Returns true if `argument` is the path of a file of tables or looks like one.
bool names_a_file(const std::string& argument);

/// Loads a file of either kind. Throws what the readers throw, naming the file.
AnyTables load_tables(const std::string& path);

/// Loads a pair. Throws std::runtime_error for baked tables, saying what to give instead.
io::TableFile load_pair(const std::string& path);

/// Where the tables came from.
Provenance provenance_of(const AnyTables& tables);

/// Makes the distribution that the tables in `path` say they were made from. Throws
/// std::runtime_error, naming the file, where their specification names none.
std::unique_ptr<distributions::SlopeDistribution> distribution_of(const std::string& path,
                                                                  const AnyTables& tables);

}  // namespace vndf::tools
