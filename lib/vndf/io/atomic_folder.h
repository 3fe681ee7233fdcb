// Folders of files: written at once or not at all, replaced by the next of their kind.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace vndf::io {

/// A folder in the making. Files are written into one with a temporary name beside the target, and
/// put_in_place() renames it. Without that call nothing is left behind.
class AtomicFolder {
 public:
  /// In this file the names of all others are listed, by which the next folder knows what to
  /// replace.
  static constexpr const char* kList = "vndf-files.txt";

  /// Parents of `target` are made. Throws FormatError, naming it, if it is there and is not a
  /// folder that is empty or holds such files and nothing else, or if its parent cannot be written.
  explicit AtomicFolder(const std::filesystem::path& target);
  ~AtomicFolder();
  AtomicFolder(const AtomicFolder&) = delete;
  AtomicFolder& operator=(const AtomicFolder&) = delete;

  /// Where the files are until put_in_place(). What else is put there must be gone by then.
  const std::filesystem::path& scratch() const { return scratch_; }

  void write(const std::string& name, std::string_view bytes);

  /// Puts the folder in the place of an earlier one. A file that is on no list is never removed.
  /// Throws as the constructor does; then the earlier one is as it was.
  void put_in_place();

 private:
  std::filesystem::path target_, scratch_;
  std::vector<std::string> names_;
};

}  // namespace vndf::io
