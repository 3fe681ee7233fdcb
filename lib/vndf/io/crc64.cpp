// CRC-64/XZ, eight bytes at a time: table k holds the effect of a byte that k bytes follow.
#include "vndf/io/crc64.h"

#include <array>

namespace vndf::io {
namespace {

constexpr std::uint64_t kPolynomial = 0xC96C5795D7870F42;
constexpr std::size_t kStride = 8;
using Tables = std::array<std::array<std::uint64_t, 256>, kStride>;

constexpr Tables make_tables() {
  Tables tables{};
  for (std::uint64_t byte = 0; byte < 256; ++byte) {
    std::uint64_t crc = byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) != 0 ? kPolynomial : 0);
    tables[0][byte] = crc;
  }
  for (std::size_t k = 1; k < kStride; ++k)
    for (std::size_t byte = 0; byte < 256; ++byte) {
      const std::uint64_t crc = tables[k - 1][byte];
      tables[k][byte] = (crc >> 8) ^ tables[0][crc & 0xFF];
    }
  return tables;
}

constexpr Tables kTables = make_tables();

std::uint64_t byte_at(std::string_view bytes, std::size_t i) {
  return static_cast<unsigned char>(bytes[i]);
}

std::uint64_t little_endian_word(std::string_view bytes) {
  std::uint64_t word = 0;
  for (std::size_t i = 0; i < kStride; ++i) word |= byte_at(bytes, i) << (8 * i);
  return word;
}

}  // namespace

void Crc64::add(std::string_view bytes) {
  std::uint64_t crc = state_;
  for (; bytes.size() >= kStride; bytes.remove_prefix(kStride)) {
    const std::uint64_t word = crc ^ little_endian_word(bytes);
    crc = 0;
    for (std::size_t i = 0; i < kStride; ++i)
      crc ^= kTables[kStride - 1 - i][(word >> (8 * i)) & 0xFF];
  }
  for (std::size_t i = 0; i < bytes.size(); ++i)
    crc = (crc >> 8) ^ kTables[0][(crc ^ byte_at(bytes, i)) & 0xFF];
  state_ = crc;
}

std::string hex_digits(std::uint64_t value) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text(16, '0');
  for (std::size_t i = 0; i < text.size(); ++i) text[15 - i] = kDigits[(value >> (4 * i)) & 0xF];
  return text;
}

}  // namespace vndf::io
