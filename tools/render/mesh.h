// Triangles with a normal and a tangent at each corner, and the shapes that the scenes are made of.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "render/vectors.h"

namespace vndf::render {

struct Mesh {
  /// For each vertex. Normals are unit vectors out of the body; tangents need not be perpendicular
  /// to them.
  std::vector<Vector> positions = {}, normals = {}, tangents = {};
  std::vector<std::array<std::uint32_t, 3>> triangles = {};
};

/// The rectangle with a corner at `corner` and the sides `x` and `y`. Its normal is that of their
/// cross product, and its tangent is `x`.
Mesh rectangle(const Vector& corner, const Vector& x, const Vector& y);

/// The box between two corners, of which `low` is less in every coordinate. The tangents of faces
/// that look up, down, to the front or to the back are the x axis, those of the others the y axis.
Mesh box(const Vector& low, const Vector& high);

/// The body that the line through the points (radius, z) of `profile` sweeps about the z axis. The
/// line runs upwards on the outside of the body, and radii are >= 0. Its corners are smoothed if
/// they turn it by less than 30 degrees. Tangents run around the axis.
Mesh revolved(const std::vector<Vec2<float>>& profile);

/// The points of half a circle about (0, z), as a profile of a sphere.
std::vector<Vec2<float>> half_circle(float radius, float z);

/// The mesh moved by `offset`.
Mesh moved(Mesh mesh, const Vector& offset);

}  // namespace vndf::render
