// Reading and replacing whole files.
#include "vndf/io/atomic_file.h"

#include <cerrno>
#include <fstream>
#include <system_error>

#include "vndf/io/format_error.h"
#include "vndf/io/table_format.h"
#include "vndf/replace_file.h"

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

void replace_file(const fs::path& path, std::string_view bytes) {
  try {
    vndf::replace_file(path, bytes);
  } catch (const ReplaceError& error) {
    throw FormatError(error.what(), error.remedy);
  }
}

}  // namespace vndf::io
