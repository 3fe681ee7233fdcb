// Writes a file as a whole or not at all, also where the machine stops in between: an interrupted
// write must not leave half a file, or an empty one, under the name that a user gave.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace vndf {

/// The file cannot be written. The message says why, and `remedy` what to do; neither names the
/// file.
class ReplaceError : public std::runtime_error {
 public:
  ReplaceError(const std::string& rule, std::string what_to_do)
      : std::runtime_error(rule), remedy(std::move(what_to_do)) {}
  std::string remedy;
};

/// Writes `bytes` under a temporary name in the same folder, waits until the disk has them and only
/// then renames the file. Throws ReplaceError on any failure. Then nothing is left behind, and a
/// file that was at `path` before is unchanged.
void replace_file(const std::filesystem::path& path, std::string_view bytes);

/// Returns a path that no other writer uses. It lies in the same folder as `path`, because a rename
/// cannot cross from one disk to another.
std::filesystem::path temporary_name(const std::filesystem::path& path);

/// Waits until the disk has the names of the files in `folder`. Without this a name may be lost
/// where the machine stops, and no file with it. Does nothing where the file system cannot.
void sync_folder(const std::filesystem::path& folder);

}  // namespace vndf
