// A stream of OpenEXR over bytes in memory, by which tests read what vndf writes.
#pragma once

#include <ImfIO.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string_view>

namespace vndf::test {

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

}  // namespace vndf::test
