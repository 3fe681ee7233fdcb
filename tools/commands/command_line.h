// The command line as text, which files keep so that people see how they were made. Nothing reads
// it again.
#pragma once

#include <string>

namespace vndf::tools {

/// Returns the command line as it was typed, quoted for a shell where it needs to be. Options that
/// do not change what is written are left out (--threads, --quiet, --json), so that the same tables
/// make the same file.
std::string command_line(int argc, const char* const* argv);

}  // namespace vndf::tools
