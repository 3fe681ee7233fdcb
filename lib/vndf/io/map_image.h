// Normal maps and slope maps in files of images: EXR, PNG and TIFF. All are read as slopes, which
// is what a distribution is estimated from.
#pragma once

#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "vndf/io/map_pixels.h"
#include "vndf/vec.h"

namespace vndf::io {

/// How the components n of normals are stored as values v. Whole numbers of 8 or 16 bits are shares
/// of the largest, v = number / 255 or number / 65535, and always shifted.
enum class NormalEncoding {
  automatic,  ///< plain if any value is negative, and shifted otherwise
  plain,      ///< n = v, with v in [-1, 1]
  shifted     ///< n = 2 v - 1, with v in [0, 1]
};

/// The slopes of a map, row by row from the top.
struct SlopeImage {
  std::size_t width, height;
  /// What the file holds, for people: "8-bit PNG, normals n = 2 v - 1".
  std::string content;
  std::vector<Vec2<double>> slopes;
};

/// The error of a file that cannot be read as a map. The message names the file, the rule that it
/// breaks, and what to do.
class MapImageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads a file of one of the formats of map_pixels.h, which its first bytes tell. The slopes of
/// normals n are (-n.x / n.z, -n.y / n.z), and n.z is that of a unit vector where a map has only
/// n.x and n.y. Throws MapImageError where the file cannot be read, and where the encoding is
/// `plain` of whole numbers or any but automatic of slopes. Throws it, naming column and row, for a
/// normal with n.z <= 0 or a length outside [0.5, 1.5] and for a value that is not finite.
SlopeImage read_slope_map(const std::filesystem::path& path,
                          NormalEncoding encoding = NormalEncoding::automatic);

/// The same of pixels that are in memory. Throws MapImageError, which calls the map `name`.
SlopeImage slope_map_of(const MapPixels& pixels, const std::string& name,
                        NormalEncoding encoding = NormalEncoding::automatic);

}  // namespace vndf::io
