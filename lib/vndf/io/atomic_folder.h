// Folders of files that belong together, such as a report page and its data. A folder appears as a
// whole or not at all, and a later one of the same kind replaces it.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace vndf::io {

/// A folder that is being written. Its files go into a folder with a temporary name beside the
/// target, which put_in_place() renames. Without that call nothing is left behind.
class AtomicFolder {
 public:
  /// The file that lists the names of all others. By it the next folder knows which files it may
  /// replace.
  static constexpr const char* kList = "vndf-files.txt";

  /// Makes the parents of `target`. Throws FormatError, which names the target, if it exists and is
  /// anything but a folder that is empty or holds only files of its list, or if its parent cannot
  /// be written.
  explicit AtomicFolder(const std::filesystem::path& target);
  ~AtomicFolder();
  AtomicFolder(const AtomicFolder&) = delete;
  AtomicFolder& operator=(const AtomicFolder&) = delete;

  /// The folder in which the files are until put_in_place(). A caller that puts other files there
  /// must remove them before.
  const std::filesystem::path& scratch() const { return scratch_; }

  void write(const std::string& name, std::string_view bytes);

  /// Replaces an earlier folder by this one. A file that is on no list is never removed. Throws as
  /// the constructor does; then the earlier folder is unchanged.
  void put_in_place();

 private:
  std::filesystem::path target_, scratch_;
  std::vector<std::string> names_;
};

}  // namespace vndf::io
