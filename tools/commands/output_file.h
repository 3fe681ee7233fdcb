// What the program writes and prints: what cannot be written is told before any work, and what did
// not arrive is never taken for success.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace vndf::tools {

/// Throws std::runtime_error, naming `path`, unless a file can be made there: its folder exists and
/// can be written, `path` is a regular file or nothing yet, and none of the `inputs`, which would
/// be lost.
void require_output(const std::string& path, const std::vector<std::string>& inputs = {});

/// `report` as text, indented. Bytes that are not UTF-8, as in names of files, become U+FFFD.
std::string json_text(const nlohmann::ordered_json& report);

/// Writes `report` with a line end to `path`, under a temporary name first. Throws
/// std::runtime_error, naming `path`.
void write_json(const std::string& path, const nlohmann::ordered_json& report);

/// Throws std::runtime_error unless all that was printed has arrived.
void require_printed();

}  // namespace vndf::tools
