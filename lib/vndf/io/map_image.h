// Normal maps and slope maps in EXR files. Both are read as slopes, which is what a distribution is
// estimated from.
#pragma once

#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <vector>

#include "vndf/vec.h"

namespace vndf::io {

/// How the components n of normals are stored as values v.
enum class NormalEncoding {
  automatic,  ///< plain if any value is negative, and shifted otherwise
  plain,      ///< n = v, with v in [-1, 1]
  shifted     ///< n = 2 v - 1, with v in [0, 1]
};

/// The slopes of a map, row by row from the top.
struct SlopeImage {
  std::size_t width, height;
  std::vector<Vec2<double>> slopes;
};

/// The error of a file that cannot be read as a map. The message names the file, the rule that it
/// breaks, and what to do.
class MapImageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Largest width and height of a map, checked before any pixel is read.
inline constexpr std::size_t kMaxMapSide = 16384;

/// Reads an EXR file of scan lines or tiles. The names of its channels tell what it holds. R, G, B
/// or X, Y, Z are a map of normals n, whose slopes are (-n.x / n.z, -n.y / n.z). slope_x, slope_y
/// or x, y are slopes. Other channels are ignored. Throws MapImageError where the file cannot be
/// read, and, naming column and row, for a normal with n.z <= 0 or a length outside [0.5, 1.5] and
/// for a value that is not finite.
SlopeImage read_slope_map(const std::filesystem::path& path,
                          NormalEncoding encoding = NormalEncoding::automatic);

}  // namespace vndf::io
