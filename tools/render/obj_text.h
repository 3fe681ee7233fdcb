// The text of a Wavefront OBJ file: positions, texture coordinates, normals and faces, after
// appendix B1 of the manual of Wavefront's Advanced Visualizer.
//
// It is our own reader because tinyobjloader 2.0.0rc10 takes what is no number for 0 without a
// word (`v nan 1 abc` is the point 0 1 0), cuts a face of 200 000 corners for 106 s, and makes half
// of the triangles of a comb. Here a line that cannot be read is an error that names it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "render/vectors.h"

namespace vndf::render {

struct ObjText {
  /// Indices of a position, of texture coordinates and of a normal, each kNone where there is none.
  using Corner = std::array<std::uint32_t, 3>;
  static constexpr std::uint32_t kNone = 0xffffffff;

  struct Face {
    std::size_t first_corner, corners;  ///< three corners or more
    std::size_t line;                   ///< for messages, from 1
  };

  std::vector<Vector> positions = {}, normals = {};
  std::vector<Vec2<float>> places = {};  ///< texture coordinates
  std::vector<Corner> corners = {};
  std::vector<Face> faces = {};
};

/// Largest coordinate of a position, so that squares of lengths are finite. A renderer scales the
/// mesh anyway.
inline constexpr double kLargestCoordinate = 1e9;

/// Reads the lines v, vt, vn and f, and passes over all others; no other file is read. Memory and
/// time are in proportion to the text. Throws io::FormatError, naming the line, for a number that
/// is none or not finite, a coordinate beyond kLargestCoordinate, an index of something that does
/// not stand above, a face of fewer than three corners, and a normal without a length.
ObjText parse_obj(std::string_view text);

}  // namespace vndf::render
