// Folders of files: written at once or not at all.
#include "vndf/io/atomic_folder.h"

#include <algorithm>
#include <fstream>
#include <system_error>

#include "vndf/io/atomic_file.h"
#include "vndf/io/format_error.h"
#include "vndf/replace_file.h"

namespace vndf::io {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kFirstLine = "Files that vndf wrote and will replace:";

FormatError error_about(const fs::path& target, const std::string& rule,
                        const std::string& remedy) {
  return {"the folder '" + target.string() + "': " + rule, remedy};
}

/// Names of the files that were written into `folder`, the list itself the last of them; none
/// without a list.
std::vector<std::string> listed_files(const fs::path& folder) {
  std::ifstream list(folder / AtomicFolder::kList);
  std::string line;
  if (!std::getline(list, line) || line != kFirstLine) return {};
  std::vector<std::string> names;
  while (std::getline(list, line))
    if (fs::path(line).filename() == line) names.push_back(line);  // nothing outside of the folder
  names.push_back(AtomicFolder::kList);
  return names;
}

void check_replaceable(const fs::path& target) {
  if (!fs::exists(target)) return;
  if (!fs::is_directory(target))
    throw error_about(target, "it is a file", "give the name of a folder");
  const auto names = listed_files(target);
  for (const auto& entry : fs::directory_iterator(target)) {
    const std::string name = entry.path().filename().string();
    if (std::find(names.begin(), names.end(), name) == names.end() || entry.is_directory())
      throw error_about(target,
                        "it holds '" + name + "', which vndf did not write and will not remove",
                        "move it away or name another folder");
  }
}

/// Removes the files that were written into `folder`, and itself unless something else is in it.
void remove_listed(const fs::path& folder) {
  std::error_code ignored;
  for (const std::string& name : listed_files(folder)) fs::remove(folder / name, ignored);
  fs::remove(folder, ignored);
}

/// Absolute, without links and without a separator at its end.
fs::path full_path(const fs::path& path) {
  const fs::path full = fs::weakly_canonical(fs::absolute(path));
  return full.has_filename() ? full : full.parent_path();
}

}  // namespace

AtomicFolder::AtomicFolder(const fs::path& target)
    : target_(full_path(target)), scratch_(temporary_name(target_)) {
  check_replaceable(target_);
  std::error_code error;
  fs::create_directories(target_.parent_path(), error);
  if (!error) fs::create_directory(scratch_, error);
  if (error)
    throw error_about(target_, "it cannot be made: " + error.message(),
                      "choose a place that can be written");
}

AtomicFolder::~AtomicFolder() {
  std::error_code ignored;
  if (!scratch_.empty()) fs::remove_all(scratch_, ignored);
}

void AtomicFolder::write(const std::string& name, std::string_view bytes) {
  replace_file(scratch_ / name, bytes);
  names_.push_back(name);
}

void AtomicFolder::put_in_place() {
  std::string list{kFirstLine};
  for (const std::string& name : names_) list += "\n" + name;
  replace_file(scratch_ / kList, list + "\n");

  check_replaceable(target_);
  const fs::path earlier = temporary_name(target_);
  const bool replaces = fs::exists(target_);
  std::error_code error;
  if (replaces) fs::rename(target_, earlier, error);
  if (!error) {
    fs::rename(scratch_, target_, error);
    std::error_code ignored;
    if (error && replaces) fs::rename(earlier, target_, ignored);
  }
  if (error)
    throw error_about(target_, "it cannot be replaced: " + error.message(), "name another folder");
  sync_folder(target_.parent_path());
  scratch_.clear();
  if (replaces) remove_listed(earlier);
}

}  // namespace vndf::io
