// How the program shows a table file and its certificate: as text for people, as JSON for programs.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "vndf/io/table_file.h"
#include "vndf/kernel_tables.h"

namespace vndf::tools {

/// Everything that is known of a table file, for people.
std::string describe(const io::TableFile& file);
std::string describe(const KernelTables& tables);

/// The same as one object.
nlohmann::ordered_json to_json(const io::TableFile& file);
nlohmann::ordered_json to_json(const KernelTables& tables);

/// That a file was written.
std::string written(const std::string& path, std::uintmax_t bytes, double seconds);

}  // namespace vndf::tools
