// What the program writes and prints: what cannot be written is told before any work, and what did
// not arrive is never taken for success.
#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace vndf::tools {

/// Adds --force, with which a file that vndf did not write is replaced.
void add_force(CLI::App& command, bool& force);

/// Throws std::runtime_error, naming `path`, unless a file can be made there: its folder exists and
/// can be written, and `path` is nothing yet or a regular file that is none of the `inputs`, which
/// would be lost. Without `force`, a file that is there must be empty or bear a mark of vndf: the
/// trailer of a pair, the first bytes of a block, the "program" of a JSON report, the
/// first line of what was exported, or the mark of a picture. So a slip of the keyboard costs
/// tables, which can be built again, and nothing else.
void require_output(const std::string& path, const std::vector<std::string>& inputs, bool force);

/// `report` as text, indented. Bytes that are not UTF-8, as in names of files, become U+FFFD.
std::string json_text(const nlohmann::ordered_json& report);

/// Writes `bytes` to `path`, under a temporary name first. Throws std::runtime_error, naming `path`.
void write_file(const std::string& path, const std::string& bytes);

/// Writes `report` with a line end, as write_file() does.
void write_json(const std::string& path, const nlohmann::ordered_json& report);

/// Throws std::runtime_error unless all that was printed has arrived.
void require_printed();

}  // namespace vndf::tools
