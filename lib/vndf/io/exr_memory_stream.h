// A stream of OpenEXR that writes into memory. Files are replaced as whole strings of bytes
// (atomic_file.h), so OpenEXR never opens a file itself.
#pragma once

#include <ImfIO.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

namespace vndf::io {

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
