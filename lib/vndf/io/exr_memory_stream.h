// Streams of OpenEXR over bytes in memory. Files are checked and replaced as whole strings of bytes
// (atomic_file.h), so OpenEXR never opens a file itself.
#pragma once

#include <ImfIO.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace vndf::io {

/// Reads from bytes, which must outlive the stream.
class ExrMemoryInput : public Imf::IStream {
 public:
  explicit ExrMemoryInput(std::string_view bytes) : IStream("table file"), bytes_(bytes) {}

  bool read(char* target, int count) override {
    const auto size = static_cast<std::size_t>(std::max(count, 0));
    if (position_ > bytes_.size() || size > bytes_.size() - position_)
      throw std::runtime_error("the file ends too early");
    std::memcpy(target, bytes_.data() + position_, size);
    position_ += size;
    return position_ < bytes_.size();
  }
  std::uint64_t tellg() override { return position_; }
  void seekg(std::uint64_t position) override { position_ = position; }

 private:
  std::string_view bytes_;
  std::size_t position_ = 0;
};

/// Writes to a string that the stream owns.
class ExrMemoryOutput : public Imf::OStream {
 public:
  ExrMemoryOutput() : OStream("table file") {}

  void write(const char* source, int count) override {
    const auto size = static_cast<std::size_t>(count);
    bytes_.resize(std::max(bytes_.size(), position_ + size));
    bytes_.replace(position_, size, source, size);
    position_ += size;
  }
  std::uint64_t tellp() override { return position_; }
  void seekp(std::uint64_t position) override { position_ = position; }

  std::string take() { return std::exchange(bytes_, {}); }

 private:
  std::string bytes_;
  std::size_t position_ = 0;
};

}  // namespace vndf::io
