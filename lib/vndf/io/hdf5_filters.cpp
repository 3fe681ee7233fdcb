// Reading pipeline messages (section IV.A.2.l) and undoing their filters.
#include "vndf/io/hdf5_filters.h"

#include <algorithm>

#include "vndf/io/byte_cursor.h"
#include "vndf/io/inflate.h"

namespace vndf::io {
namespace {

constexpr std::size_t kChecksumBytes = 4;

/// Name and settings are not needed. In version 1 both are padded, in version 2 the known filters
/// have no name.
Hdf5Filter next_filter(ByteCursor& cursor, int version) {
  const auto number = cursor.number<std::uint16_t>();
  if (number < 1 || number > 3)
    throw broken_file("its values went through the HDF5 filter " + std::to_string(number) +
                      ", not through shuffle, deflate and fletcher32 only");
  const std::uint16_t name_bytes = version == 1 ? cursor.number<std::uint16_t>() : 0;
  cursor.take(2);  // whether it may be skipped
  const std::size_t settings = cursor.number<std::uint16_t>();
  cursor.take(name_bytes);
  cursor.take(4 * (version == 1 ? settings + settings % 2 : settings));
  return Hdf5Filter{number};
}

/// The checksum of Fletcher (1982) over big-endian words of 16 bits, as HDF5 has it. The sums are
/// of 64 bits, which hold 65536 words between two divisions.
std::uint32_t fletcher32(std::string_view bytes) {
  std::uint64_t low = 0, high = 0;
  const auto divide = [&] { low %= 65535, high %= 65535; };
  for (std::size_t k = 0; k < bytes.size(); k += 2) {
    const auto first = static_cast<std::uint8_t>(bytes[k]);
    const auto second = k + 1 < bytes.size() ? static_cast<std::uint8_t>(bytes[k + 1]) : 0;
    low += static_cast<std::uint64_t>(first << 8 | second);
    high += low;
    if (k % 65536 == 0) divide();
  }
  divide();
  return static_cast<std::uint32_t>(high << 16 | low);
}

/// HDF5 leaves a sum of 65535 where the remainder is 0.
bool same_sum(std::uint32_t a, std::uint32_t b) {
  return a % 65536 % 65535 == b % 65536 % 65535 && (a >> 16) % 65535 == (b >> 16) % 65535;
}

std::string without_checksum(std::string_view bytes) {
  if (bytes.size() < kChecksumBytes) throw broken_file("values in it have no checksum");
  const std::string_view values = bytes.substr(0, bytes.size() - kChecksumBytes);
  ByteCursor end(bytes.substr(values.size()));
  if (!same_sum(end.number<std::uint32_t>(), fletcher32(values)))
    throw broken_file("values in it do not match their checksum");
  return std::string(values);
}

/// Brings together the bytes of each value, which shuffling put apart: first of all values the
/// first byte, then the second. What is left over stays behind them.
std::string unshuffled(std::string_view bytes, std::size_t value_bytes) {
  const std::size_t count = bytes.size() / value_bytes;
  std::string values(bytes);
  for (std::size_t b = 0; b < value_bytes; ++b)
    for (std::size_t k = 0; k < count; ++k) values[k * value_bytes + b] = bytes[b * count + k];
  return values;
}

}  // namespace

std::vector<Hdf5Filter> hdf5_filters(std::string_view message) {
  ByteCursor cursor(message);
  const int version = cursor.number<std::uint8_t>();
  const int count = cursor.number<std::uint8_t>();
  if (version != 1 && version != 2) throw broken_file("its filters are of an unknown HDF5 version");
  if (version == 1) cursor.take(6);
  std::vector<Hdf5Filter> filters;
  for (int k = 0; k < count; ++k) {
    filters.push_back(next_filter(cursor, version));
    if (std::ranges::count(filters, filters.back()) > 1)
      throw broken_file("its values went through an HDF5 filter twice");
  }
  return filters;
}

std::string undo_filters(std::string_view stored, const std::vector<Hdf5Filter>& filters,
                         std::uint32_t skipped, std::size_t size, std::size_t value_bytes) {
  std::string bytes(stored);
  for (std::size_t k = filters.size(); k-- > 0;) {
    if ((skipped >> k & 1) != 0) continue;
    switch (filters[k]) {
      case Hdf5Filter::deflate:
        bytes = inflate(bytes, size + kChecksumBytes);
        break;
      case Hdf5Filter::shuffle:
        bytes = unshuffled(bytes, value_bytes);
        break;
      case Hdf5Filter::fletcher32:
        bytes = without_checksum(bytes);
        break;
    }
  }
  if (bytes.size() != size) throw broken_file("values in it are fewer or more than their shape");
  return bytes;
}

}  // namespace vndf::io
