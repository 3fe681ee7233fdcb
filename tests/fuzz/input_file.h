// The input of a fuzzer as a file, for readers whose libraries open files themselves.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace vndf::fuzz {

/// Is there while this object lives. Each process has one at a time.
class InputFile {
 public:
  explicit InputFile(std::string_view bytes) {
    std::ofstream(path_, std::ios::binary | std::ios::trunc) << bytes;
  }
  ~InputFile() { std::filesystem::remove(path_); }
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_ = std::filesystem::temp_directory_path() /
                                std::string("vndf-fuzz-").append(std::to_string(getpid()));
};

}  // namespace vndf::fuzz
