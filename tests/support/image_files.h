// The bytes of small PNG and TIFF files, written after their specifications and not by the
// libraries that read them, so that tests can break every rule of the formats.
#pragma once

#include <zlib.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace vndf::test {

/// `count` bytes of a number, the highest first or last.
inline std::string number_bytes(std::uint32_t value, int count, bool highest_first = true) {
  std::string bytes;
  for (int i = 0; i < count; ++i) {
    const int place = highest_first ? count - 1 - i : i;
    bytes += static_cast<char>(value >> (8 * place) & 0xff);
  }
  return bytes;
}

inline std::string deflated(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string packed(size, '\0');
  compress(reinterpret_cast<Bytef*>(packed.data()), &size,
           reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
  packed.resize(size);
  return packed;
}

/// A chunk of a PNG file with the right checksum.
inline std::string png_chunk(const std::string& type, const std::string& data) {
  const std::string body = type + data;
  const auto sum =
      crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()));
  return number_bytes(static_cast<std::uint32_t>(data.size()), 4) + body +
         number_bytes(static_cast<std::uint32_t>(sum), 4);
}

struct PngHeader {
  std::uint32_t width = 1, height = 1;
  int bits = 8, colour_type = 2;  // 2: RGB, 6: RGB and alpha, 0: grey, 3: palette
};

/// `rows` are the samples of each row in bytes, without a filter.
inline std::string png_file(const PngHeader& h, const std::vector<std::string>& rows,
                            const std::string& other_chunks = {}) {
  std::string pixels;
  for (const std::string& row : rows) pixels += std::string(1, '\0') + row;
  return "\x89PNG\r\n\x1a\n" +
         png_chunk("IHDR", number_bytes(h.width, 4) + number_bytes(h.height, 4) +
                               number_bytes(static_cast<std::uint32_t>(h.bits), 1) +
                               number_bytes(static_cast<std::uint32_t>(h.colour_type), 1) +
                               std::string(3, '\0')) +
         other_chunks + png_chunk("IDAT", deflated(pixels)) + png_chunk("IEND", "");
}

/// A field of a TIFF file: one number of 2 (type 3) or 4 bytes (type 4), or several of 2.
struct TiffField {
  std::uint32_t tag;
  int type;
  std::vector<std::uint32_t> values;
};

/// A TIFF file of one strip, which the fields do not name. The fields are in order of tags; 273 and
/// 279 are added behind those that are smaller.
inline std::string tiff_file(std::vector<TiffField> fields, const std::string& strip,
                             bool big_endian = false) {
  const auto number = [&](std::uint32_t value, int count) {
    return number_bytes(value, count, big_endian);
  };
  constexpr std::uint32_t kHead = 8;
  const auto insert = [&](std::uint32_t tag, std::uint32_t value) {
    auto place = fields.begin();
    while (place != fields.end() && place->tag < tag) ++place;
    fields.insert(place, {tag, 4, {value}});
  };
  insert(273, kHead);
  insert(279, static_cast<std::uint32_t>(strip.size()));
  const auto directory = static_cast<std::uint32_t>(kHead + strip.size());
  auto behind = static_cast<std::uint32_t>(directory + 2 + 12 * fields.size() + 4);
  std::string entries, arrays;
  for (const TiffField& f : fields) {
    const int size = f.type == 3 ? 2 : 4;
    std::string data;
    for (const std::uint32_t value : f.values) data += number(value, size);
    const bool inside = data.size() <= 4;
    entries += number(f.tag, 2) + number(static_cast<std::uint32_t>(f.type), 2) +
               number(static_cast<std::uint32_t>(f.values.size()), 4) +
               (inside ? data + std::string(4 - data.size(), '\0') : number(behind, 4));
    if (inside) continue;
    behind += static_cast<std::uint32_t>(data.size());
    arrays += data;
  }
  return std::string(big_endian ? std::string_view("MM\0*", 4) : std::string_view("II*\0", 4)) +
         number(directory, 4) + strip + number(static_cast<std::uint32_t>(fields.size()), 2) +
         entries + number(0, 4) + arrays;
}

/// The fields of an RGB image of one strip.
inline std::vector<TiffField> rgb_fields(std::uint32_t width, std::uint32_t height,
                                         std::uint32_t bits, std::uint32_t samples = 3,
                                         std::uint32_t format = 1, std::uint32_t compression = 1) {
  return {{256, 4, {width}},
          {257, 4, {height}},
          {258, 3, std::vector<std::uint32_t>(samples, bits)},
          {259, 3, {compression}},
          {262, 3, {2}},
          {277, 3, {samples}},
          {278, 4, {height}},
          {284, 3, {1}},
          {339, 3, std::vector<std::uint32_t>(samples, format)}};
}

}  // namespace vndf::test
