// Files as strings of bytes. A file is read as a whole and replaced as a whole, so that an
// interrupted write never leaves half a file under the name that a user gave.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace vndf::io {

/// Throws FormatError unless there is a regular file at `path`.
void require_file(const std::filesystem::path& path);

/// Returns the bytes of a regular file. Throws FormatError if it is missing, empty, not a file, too
/// large for a table file (kMaxFileBytes) or cannot be read.
std::string read_file(const std::filesystem::path& path);

/// As vndf::replace_file(), but throws FormatError.
void replace_file(const std::filesystem::path& path, std::string_view bytes);

}  // namespace vndf::io
