// The checksum of files and of their content. It finds accidents, not forgery. It is the 64-bit
// cyclic redundancy check of ECMA-182 in the variant of the XZ format ("CRC-64/XZ"):
// reflected polynomial C96C5795D7870F42, initial value and final inversion of all ones.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace vndf::io {

class Crc64 {
 public:
  /// Continues the check over `bytes`.
  void add(std::string_view bytes);
  /// The check of everything added so far; 995DC9BBDF1939FA for the nine bytes "123456789".
  std::uint64_t value() const { return ~state_; }

 private:
  std::uint64_t state_ = ~std::uint64_t{0};
};

/// 16 lower-case hexadecimal digits.
std::string hex_digits(std::uint64_t value);

}  // namespace vndf::io
