// Normal maps and slope maps in EXR files, read as slopes.
#pragma once

#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <vector>

#include "vndf/vec.h"

namespace vndf::io {

/// How the components of normals are stored. `automatic`: as they are if any of them is negative,
/// shifted otherwise.
enum class NormalEncoding { automatic, plain, shifted };  // n = v in [-1, 1], n = 2 v - 1

/// The slopes of a map, row by row from the top.
struct SlopeImage {
  std::size_t width, height;
  std::vector<Vec2<double>> slopes;
};

/// A file that is no map or cannot be read. The message names the file, the rule that it breaks,
/// and what to do.
class MapImageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Largest width and height of a map, checked before any pixel is read.
inline constexpr std::size_t kMaxMapSide = 16384;

/// Reads a scan line or tiled EXR file. Its channels say what it is: R, G, B or X, Y, Z are a map
/// of normals n, whose slopes are (-n.x / n.z, -n.y / n.z); slope_x, slope_y or x, y are slopes.
/// Other channels are ignored. Throws MapImageError; among other reasons for a normal with n.z <= 0
/// or a length outside [0.5, 1.5], and for a value that is not finite, naming its column and row.
SlopeImage read_slope_map(const std::filesystem::path& path,
                          NormalEncoding encoding = NormalEncoding::automatic);

}  // namespace vndf::io
