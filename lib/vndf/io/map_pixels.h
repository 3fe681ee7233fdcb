// The pixels of a map as a file of images holds them, before they are taken for normals or slopes,
// and how many of them a file may have. Every reader checks the size that a header declares before
// it allocates anything.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace vndf::io {

/// Largest width and height of a map.
inline constexpr std::size_t kMaxMapSide = 16384;

/// Most texels of a file of that size. Four million may be anything. Beyond, a map with fewer than
/// a bit for each texel has large areas of one colour, which have no slopes to estimate, or its
/// file declares what it does not have.
constexpr std::uint64_t most_texels(std::uint64_t file_bytes) {
  return (std::uint64_t{4} << 20) + 8 * file_bytes;
}

struct MapPixels {
  /// What the channels are: normals n, the x and y of normals, or slopes.
  enum class Kind { normals, normals_without_z, slopes };

  std::size_t width = 0, height = 0;
  Kind kind = Kind::normals;
  /// For people: "16-bit PNG".
  std::string format = {};
  /// Whether the values are shares of the largest integer, which cannot be negative.
  bool whole_numbers = false;
  /// Three values for each texel of normals, or else two; row by row from the top.
  std::vector<float> values = {};

  std::size_t channels() const { return kind == Kind::normals ? 3 : 2; }
};

/// Throws FormatError unless each side is from 1 to kMaxMapSide and the texels are at most
/// most_texels().
void check_map_size(std::int64_t width, std::int64_t height, std::uint64_t file_bytes);

/// Read a map of normals or slopes. Throw FormatError for a file that is not read, with the rule
/// that it breaks and what to do.

/// EXR, scan lines or tiles, flat. R, G, B or X, Y, Z are normals; X, Y or R, G normals without z;
/// slope_x, slope_y or x, y slopes. Other channels are ignored.
MapPixels read_exr_map(const std::filesystem::path& path);

/// PNG of the colours RGB, with or without alpha, of 8 or 16 bits: normals.
MapPixels read_png_map(const std::filesystem::path& path);

/// TIFF of the colours RGB in strips, of 8 or 16 bits or of 32-bit floats; uncompressed, PackBits,
/// LZW or Deflate: normals. Further samples are ignored, and so are further pages.
MapPixels read_tiff_map(const std::filesystem::path& path);

}  // namespace vndf::io
