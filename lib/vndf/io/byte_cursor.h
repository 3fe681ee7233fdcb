// Takes numbers and texts one after the other from bytes that nobody vouches for. Whatever the
// bytes say, nothing outside of them is read.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "vndf/io/format_error.h"

namespace vndf::io {

/// The error of a file whose parts contradict each other or the format; `rule` is a whole clause.
inline FormatError broken_file(const std::string& rule) {
  return {rule, "correct the program that wrote it, or build it again"};
}

class ByteCursor {
 public:
  explicit ByteCursor(std::string_view bytes) : rest_(bytes) {}

  std::size_t left() const { return rest_.size(); }

  /// The next `count` bytes. Throws FormatError if there are fewer.
  std::string_view take(std::uint64_t count) {
    if (count > rest_.size()) throw broken_file("a part of it ends before all was said");
    const std::string_view taken = rest_.substr(0, static_cast<std::size_t>(count));
    rest_.remove_prefix(taken.size());
    return taken;
  }

  /// As take(), and then what is between there and the next multiple of eight bytes.
  std::string_view take_padded(std::uint64_t count) {
    const std::string_view taken = take(count);
    take((8 - taken.size() % 8) % 8);
    return taken;
  }

  /// The next number, which is little-endian in every format that is read.
  template <class T>
  T number() {
    std::array<char, sizeof(T)> bytes;
    std::ranges::copy(take(sizeof(T)), bytes.begin());
    if constexpr (std::endian::native == std::endian::big) std::ranges::reverse(bytes);
    return std::bit_cast<T>(bytes);
  }

  /// The text up to the next zero byte, and that byte. Throws FormatError if there is none.
  std::string_view text() {
    const std::string_view taken = take(rest_.find('\0'));
    take(1);
    return taken;
  }

 private:
  std::string_view rest_;
};

/// All numbers of `bytes`, one after the other. Throws FormatError if the last is cut short.
template <class T>
std::vector<T> numbers_in(std::string_view bytes) {
  std::vector<T> numbers;
  numbers.reserve(bytes.size() / sizeof(T));
  for (ByteCursor cursor(bytes); cursor.left() > 0;) numbers.push_back(cursor.number<T>());
  return numbers;
}

}  // namespace vndf::io
