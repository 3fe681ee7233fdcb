// Replacing whole files. The standard library cannot wait for a disk, so POSIX does, where it is.
#include "vndf/replace_file.h"

#include <cerrno>
#include <cstdio>
#include <random>
#include <system_error>
#include <utility>

#if __has_include(<unistd.h>)
#include <fcntl.h>
#include <unistd.h>
#endif

namespace vndf {
namespace {

namespace fs = std::filesystem;

std::string last_error() {
  return std::generic_category().message(errno);
}

/// Whether the disk has what was written to `file`.
bool synced(std::FILE* file) {
#if __has_include(<unistd.h>)
  return std::fflush(file) == 0 && fsync(fileno(file)) == 0;
#else
  return std::fflush(file) == 0;
#endif
}

/// A new file that vanishes with this object unless it was renamed.
class TemporaryFile {
 public:
  explicit TemporaryFile(const fs::path& path)
      : name_(temporary_name(path)), file_(std::fopen(name_.string().c_str(), "wbx")) {
    if (file_ == nullptr)
      throw ReplaceError("it cannot be created: " + last_error(),
                         "choose a folder that can be written");
  }
  ~TemporaryFile() {
    if (file_ != nullptr) std::fclose(file_);
    std::error_code ignored;
    if (!renamed_) fs::remove(name_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  void write(std::string_view bytes) {
    const bool written =
        std::fwrite(bytes.data(), 1, bytes.size(), file_) == bytes.size() && synced(file_);
    const std::string why = last_error();
    const bool closed = std::fclose(std::exchange(file_, nullptr)) == 0;
    if (!written || !closed)
      throw ReplaceError("it cannot be written: " + (written ? last_error() : why),
                         "make room or choose another folder");
  }

  void rename_to(const fs::path& path) {
    std::error_code error;
    fs::rename(name_, path, error);
    if (error)
      throw ReplaceError("it cannot be replaced: " + error.message(), "choose another name");
    renamed_ = true;
  }

 private:
  fs::path name_;
  std::FILE* file_;
  bool renamed_ = false;
};

}  // namespace

fs::path temporary_name(const fs::path& path) {
  std::random_device random;
  fs::path name = path;
  name += ".";
  name += std::to_string(random());
  name += ".tmp";
  return name;
}

void replace_file(const fs::path& path, std::string_view bytes) {
  TemporaryFile file(path);
  file.write(bytes);
  file.rename_to(path);
  sync_folder(path.parent_path());
}

void sync_folder([[maybe_unused]] const fs::path& folder) {
#if __has_include(<unistd.h>)
  const int id = open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_CLOEXEC);
  if (id < 0) return;
  (void)fsync(id);
  close(id);
#endif
}

}  // namespace vndf
