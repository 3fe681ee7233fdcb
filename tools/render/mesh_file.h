// Meshes from Wavefront OBJ files, with what they do not say: normals and tangents.
#pragma once

#include <filesystem>

#include "render/mesh.h"
#include "render/obj_text.h"

namespace vndf::render {

/// The mesh of a text. Faces of more than three corners are cut into triangles. Those without area
/// are left out: those of which the height is less than 1e-7 of the longest side, because floats do
/// not tell where they look. Where a corner has no normal, it is the average of the triangles that
/// meet at its position, weighted by area; so sharp edges need normals in the file. Tangents run
/// along the first texture coordinate. Where there is none, or it runs along the normal, they are
/// horizontal, and along x where the normal is vertical. Throws io::FormatError if there are no
/// triangles, if the largest side of their box is less than 1e-9, and for a face of five corners or
/// more that cannot be cut into a fan, as convex ones can.
Mesh mesh_of(const ObjText& obj);

/// The mesh of an OBJ file of at most 512 MiB. Throws std::runtime_error, naming the file and the
/// line, where it cannot be read or parse_obj() or mesh_of() throw.
Mesh read_obj(const std::filesystem::path& path);

}  // namespace vndf::render
