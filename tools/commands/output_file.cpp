// What the program writes and prints.
#include "commands/output_file.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <system_error>

#include "vndf/io/atomic_file.h"
#include "vndf/io/checksum_trailer.h"
#include "vndf/io/format_error.h"
#include "vndf/io/picture_mark.h"
#include "vndf/kernel_block.h"

namespace vndf::tools {
namespace {

namespace fs = std::filesystem;

/// The folder that `path` lies in.
fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

/// The first and the last bytes of a file, where the marks are.
std::string ends_of(const fs::path& path) {
  constexpr std::size_t kBytes = 4096;
  std::ifstream file(path, std::ios::binary);
  std::string bytes(2 * kBytes, '\0');
  file.read(bytes.data(), kBytes);
  const auto first = static_cast<std::size_t>(file.gcount());
  if (first < kBytes) return bytes.substr(0, first);
  file.seekg(-static_cast<std::streamoff>(kBytes), std::ios::end);
  file.read(bytes.data() + kBytes, kBytes);
  return bytes;
}

/// Whether vndf wrote the file, or nothing is in it.
bool is_replaceable(const fs::path& path) {
  const std::string bytes = ends_of(path);
  if (bytes.empty()) return fs::is_empty(path);  // and not one that cannot be read
  if (bytes.starts_with(kKernelMagic)) return true;
  const auto holds = [&](std::string_view mark) { return bytes.find(mark) != std::string::npos; };
  return holds(io::kTrailerText) || holds("\"program\": \"vndf ") || holds(", exported by vndf ") ||
         holds(io::kSvgMark) || holds(io::kPngMark) || holds(io::kExrMark);
}

}  // namespace

void add_force(CLI::App& command, bool& force) {
  command.add_flag("--force", force, "Replace an existing file that vndf did not write");
}

void require_output(const std::string& path, const std::vector<std::string>& inputs, bool force) {
  const auto refuse = [&](const std::string& why) { throw std::runtime_error(path + ": " + why); };
  const fs::path folder = folder_of(path);
  std::error_code error;
  if (!fs::is_directory(folder, error))
    refuse("the folder '" + folder.string() + "' does not exist; make it or choose another");
  if (access(folder.c_str(), W_OK | X_OK) != 0)
    refuse("the folder '" + folder.string() + "' cannot be written; choose another");
  const fs::file_status status = fs::status(path, error);
  if (fs::exists(status) && !fs::is_regular_file(status))
    refuse("it exists and is not a file, so that it cannot be replaced; choose another name");
  for (const std::string& input : inputs)
    if (fs::equivalent(path, input, error))
      refuse("it is also read, and would be lost; choose another name to write to");
  if (!force && fs::exists(status) && !is_replaceable(path))
    refuse("it exists and vndf did not write it; choose another name, or give --force");
}

std::string json_text(const nlohmann::ordered_json& report) {
  return report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

void write_file(const std::string& path, const std::string& bytes) {
  try {
    io::replace_file(path, bytes);
  } catch (const io::FormatError& error) {
    throw std::runtime_error(path + ": " + error.what());
  }
}

void write_json(const std::string& path, const nlohmann::ordered_json& report) {
  write_file(path, json_text(report) + "\n");
}

void require_printed() {
  if (!std::cout.flush())
    throw std::runtime_error("cannot write to standard output; make room or choose another place");
}

}  // namespace vndf::tools
