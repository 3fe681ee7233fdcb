// Files as single strings of bytes: read at once, replaced at once or not at all.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace vndf::io {

/// Throws FormatError unless there is a regular file at `path`.
void require_file(const std::filesystem::path& path);

/// The bytes of a regular file. Throws FormatError if it is missing, empty, not a file, too large
/// for a table file (kMaxFileBytes) or cannot be read.
std::string read_file(const std::filesystem::path& path);

/// A path in the same folder, because a rename cannot leave a disk, that no other writer uses.
std::filesystem::path temporary_name(const std::filesystem::path& path);

/// Writes `bytes` under a temporary name in the same folder, then renames. Throws FormatError on
/// any failure; then nothing is left behind and a file already at `path` is as it was.
void replace_file(const std::filesystem::path& path, std::string_view bytes);

}  // namespace vndf::io
