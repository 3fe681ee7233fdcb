// Reading and replacing whole files.
#include "vndf/io/atomic_file.h"

#include <cerrno>
#include <cstdio>
#include <fstream>
#include <random>
#include <system_error>
#include <utility>

#include "vndf/io/format_error.h"
#include "vndf/io/table_format.h"

namespace vndf::io {
namespace {

namespace fs = std::filesystem;

std::string last_error() {
  return std::generic_category().message(errno);
}

std::size_t checked_size(const fs::path& path) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(path, error);
  if (error) throw FormatError("it cannot be read: " + error.message(), "check its permissions");
  if (size == 0) throw FormatError("it is empty", "copy it again, or build it again");
  if (size > kMaxFileBytes)
    throw FormatError(
        "it is larger than any table file (" + std::to_string(kMaxFileBytes) + " bytes)",
        "give a file written by vndf");
  return static_cast<std::size_t>(size);
}

/// A new file that vanishes with this object unless it was renamed.
class TemporaryFile {
 public:
  explicit TemporaryFile(const fs::path& path)
      : name_(temporary_name(path)), file_(std::fopen(name_.c_str(), "wbx")) {
    if (file_ == nullptr)
      throw FormatError("it cannot be created: " + last_error(),
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
    const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file_) == bytes.size();
    const bool closed = std::fclose(std::exchange(file_, nullptr)) == 0;
    if (!written || !closed)
      throw FormatError("it cannot be written: " + last_error(),
                        "make room or choose another folder");
  }

  void rename_to(const fs::path& path) {
    std::error_code error;
    fs::rename(name_, path, error);
    if (error)
      throw FormatError("it cannot be replaced: " + error.message(), "choose another name");
    renamed_ = true;
  }

 private:
  fs::path name_;
  std::FILE* file_;
  bool renamed_ = false;
};

}  // namespace

void require_file(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) throw FormatError("there is no such file", "check the path");
  if (!fs::is_regular_file(status))
    throw FormatError("it is not a file", "give the path of a file");
}

std::string read_file(const fs::path& path) {
  require_file(path);
  std::string bytes(checked_size(path), '\0');
  std::ifstream in(path, std::ios::binary);
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!in) throw FormatError("it cannot be read: " + last_error(), "check its permissions");
  return bytes;
}

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
}

}  // namespace vndf::io
