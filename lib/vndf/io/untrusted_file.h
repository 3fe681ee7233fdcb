// A file that anybody may have made, and how much a reader may take from it. Both readers get their
// bytes here, so that no file can make them run in circles, unpack the same bytes again and again,
// or take more memory than its size gives it a right to.
#pragma once

#include <cstdint>
#include <string_view>

#include "vndf/io/byte_cursor.h"

namespace vndf::io {

/// Most bytes that the arrays of a file may have, unpacked. The pairs of ggx of 1024, 2048 and 4096
/// rows hold 4 times the size of their files. The multiple leaves room for tables whose rows are
/// all the same, which deflate by up to 1000, beside one of another size; the constant is for files
/// that are small themselves. In all, a reader and from_stored() take at most 8 times this, which
/// tests/io/table_file_test.cpp measures.
constexpr std::uint64_t most_array_bytes(std::uint64_t file_bytes) {
  return (std::uint64_t{16} << 20) + 16 * file_bytes;
}

class UntrustedFile {
 public:
  /// `bytes` must outlive the file and all that block() returns.
  explicit UntrustedFile(std::string_view bytes)
      : bytes_(bytes), unread_(bytes.size()), unclaimed_(most_array_bytes(bytes.size())) {}

  std::size_t size() const { return bytes_.size(); }

  /// The bytes from `begin` to the end of the file, which are not counted as read.
  std::string_view from(std::uint64_t begin) const {
    if (begin > bytes_.size()) throw broken_file("it points outside of itself");
    return bytes_.substr(static_cast<std::size_t>(begin));
  }

  /// Counts `count` bytes as read. Throws FormatError where all blocks together are more than the
  /// file has: no part of a whole file is read twice, so it points in circles, or twice to one
  /// place.
  void read(std::uint64_t count) {
    if (count > unread_) throw broken_file("it points to some of its bytes more than once");
    unread_ -= count;
  }

  /// `count` bytes from `begin`. Throws FormatError unless they are inside the file, and as read().
  std::string_view block(std::uint64_t begin, std::uint64_t count) {
    read(count);
    return ByteCursor(from(begin)).take(count);
  }

  /// Must be called before the values of an array are allocated. Throws FormatError where all
  /// arrays together are more than most_array_bytes() of the file.
  void claim(std::uint64_t array_bytes) {
    if (array_bytes > unclaimed_)
      throw broken_file("its arrays are larger than a file of its size can hold");
    unclaimed_ -= array_bytes;
  }

 private:
  std::string_view bytes_;
  std::uint64_t unread_, unclaimed_;
};

}  // namespace vndf::io
