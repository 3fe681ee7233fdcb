// How the program shows a table file and its certificate: as text for people, as JSON for programs.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "io/table_file.h"

namespace vndf::tools {

/// Everything that is known of a table file, for people.
std::string describe(const io::TableFile& file);

/// The same as one object.
nlohmann::ordered_json to_json(const io::TableFile& file);

}  // namespace vndf::tools
