// Reads the attributes of EXR headers that decide how much memory OpenEXR takes. Names and numbers
// are those of "OpenEXR File Layout" (the OpenEXR project).
#include "vndf/io/exr_map_header.h"

#include <algorithm>
#include <array>
#include <string>

#include "vndf/io/byte_cursor.h"
#include "vndf/io/format_error.h"
#include "vndf/io/map_pixels.h"

namespace vndf::io {
namespace {

constexpr std::uint32_t kTiled = 0x200, kManyParts = 0x1000;
constexpr std::size_t kMaxParts = 64, kMaxChannels = 64;
constexpr std::uint64_t kMaxTileBytes = std::uint64_t{64} << 20;
// A pixel of a channel has four bytes at most. A place of a tile takes eight bytes in the file.
constexpr std::uint64_t kPixelBytes = 4, kPlaceBytes = 8;

struct Header {
  std::int64_t width = 1, height = 1;
  std::size_t channels = 0;
  std::uint64_t tile_width = 0, tile_height = 0;  // 0 where there are no tiles
};

void require_whole(bool whole) {
  if (!whole)
    throw FormatError("an attribute of it has another size than it says", "copy it again");
}

std::size_t count_channels(ByteCursor list) {
  constexpr std::uint64_t kChannelBytes = 16;  // behind the name
  std::size_t count = 0;
  for (; !list.text().empty(); ++count) list.take(kChannelBytes);
  require_whole(list.left() == 0);
  return count;
}

struct TypeSize {
  std::string_view type;
  std::size_t bytes;
};

/// The types of attributes whose values have one size.
constexpr TypeSize kTypeSizes[] = {{"box2f", 16},      {"box2i", 16},    {"chromaticities", 32},
                                   {"compression", 1}, {"double", 8},    {"deepImageState", 1},
                                   {"envmap", 1},      {"float", 4},     {"int", 4},
                                   {"keycode", 28},    {"lineOrder", 1}, {"m33d", 72},
                                   {"m33f", 36},       {"m44d", 128},    {"m44f", 64},
                                   {"rational", 8},    {"tiledesc", 9},  {"timecode", 8},
                                   {"v2d", 16},        {"v2f", 8},       {"v2i", 8},
                                   {"v3d", 24},        {"v3f", 12},      {"v3i", 12}};

/// Throws FormatError unless OpenEXR, which reads a value as its type says and not as long as the
/// header says, ends where this reader does. Else the two would see different headers. A preview
/// and a list of texts say once more how long they are, and OpenEXR allocates that much.
void check_value(std::string_view type, ByteCursor value) {
  const auto* fixed = std::ranges::find(kTypeSizes, type, &TypeSize::type);
  if (fixed != std::end(kTypeSizes)) require_whole(value.left() == fixed->bytes);
  if (type == "chlist") count_channels(value);
  if (type == "preview") {
    const std::uint64_t width = value.number<std::uint32_t>();
    const std::uint64_t height = value.number<std::uint32_t>();
    require_whole(width <= kMaxMapSide && height <= kMaxMapSide &&
                  width * height * kPixelBytes == value.left());
  }
  if (type == "stringvector")
    while (value.left() > 0) value.take(value.number<std::uint32_t>());
}

void read_attribute(Header& header, std::string_view name, ByteCursor value) {
  if (name == "dataWindow") {
    std::array<std::int64_t, 4> window{};
    for (auto& edge : window) edge = value.number<std::int32_t>();
    header.width = window[2] - window[0] + 1;
    header.height = window[3] - window[1] + 1;
  } else if (name == "channels") {
    header.channels = count_channels(value);
  } else if (name == "tiles") {
    header.tile_width = value.number<std::uint32_t>();
    header.tile_height = value.number<std::uint32_t>();
  }
}

/// Returns whether there was a header: none at all ends the list of headers.
bool read_header(ByteCursor& cursor, Header& header) {
  std::string_view name = cursor.text();
  if (name.empty()) return false;
  for (; !name.empty(); name = cursor.text()) {
    const std::string_view type = cursor.text();
    const ByteCursor value(cursor.take(cursor.number<std::uint32_t>()));
    check_value(type, value);
    read_attribute(header, name, value);
  }
  return true;
}

void check_header(const Header& header, bool tiled, std::uint64_t file_bytes) {
  constexpr auto kMost = static_cast<std::int64_t>(kMaxMapSide);
  if (header.width < 1 || header.height < 1 || header.width > kMost || header.height > kMost)
    check_map_size(header.width, header.height, file_bytes);  // throws
  if (header.channels > kMaxChannels)
    throw FormatError("it has " + std::to_string(header.channels) + " channels",
                      "give a map of at most " + std::to_string(kMaxChannels));
  const std::uint64_t wide = header.tile_width, high = header.tile_height;
  if (wide == 0 && high == 0 && !tiled) return;
  const auto side = [](std::uint64_t tile) { return tile >= 1 && tile <= kMaxMapSide; };
  if (!side(wide) || !side(high) || wide * high * header.channels * kPixelBytes > kMaxTileBytes)
    throw FormatError(
        "its tiles have " + std::to_string(wide) + " x " + std::to_string(high) + " texels",
        "give a map of smaller tiles, or of scan lines");
  const auto tiles = [](std::int64_t side_length, std::uint64_t tile) {
    return (static_cast<std::uint64_t>(side_length) + tile - 1) / tile;
  };
  if (tiles(header.width, wide) * tiles(header.height, high) * kPlaceBytes > file_bytes)
    throw FormatError("it has more tiles than a file of its size has room for", "copy it again");
}

}  // namespace

void check_exr_headers(std::string_view head, std::uint64_t file_bytes) {
  ByteCursor cursor(head);
  cursor.take(4);  // the magic number
  const auto flags = cursor.number<std::uint32_t>();
  const bool many = (flags & kManyParts) != 0;
  std::size_t parts = 0;
  for (Header header; read_header(cursor, header); header = {}) {
    check_header(header, (flags & kTiled) != 0, file_bytes);
    if (++parts > kMaxParts)
      throw FormatError("it has more than " + std::to_string(kMaxParts) + " parts",
                        "give a map of one part");
    if (!many) break;
  }
}

}  // namespace vndf::io
