// Bytes as the text of an OBJ file.
#include <cmath>

#include "fuzz/fuzz_target.h"
#include "render/mesh_file.h"
#include "vndf/io/format_error.h"

namespace {

using vndf::render::Mesh;
using vndf::render::Vector;

bool is_unit(const Vector& v) {
  return std::abs(vndf::render::length(v) - 1) < 1e-5f;
}

void require_usable(const Mesh& mesh) {
  const std::size_t count = mesh.positions.size();
  vndf::fuzz::require(mesh.normals.size() == count && mesh.tangents.size() == count,
                      "a vertex has no normal or no tangent");
  for (std::size_t v = 0; v < count; ++v) {
    const Vector across = vndf::render::cross(mesh.normals[v], mesh.tangents[v]);
    vndf::fuzz::require(is_unit(mesh.normals[v]) && is_unit(mesh.tangents[v]) &&
                            vndf::render::length(across) > 5e-4f,
                        "a normal and a tangent make no frame");
  }
  vndf::fuzz::require(!mesh.triangles.empty(), "a mesh has no triangle");
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t v : triangle)
      vndf::fuzz::require(v < count, "a triangle has a corner that is no vertex");
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  vndf::fuzz::accept_or_throw<vndf::io::FormatError>([&] {
    require_usable(vndf::render::mesh_of(vndf::render::parse_obj(vndf::fuzz::text_of(data, size))));
  });
  return 0;
}
