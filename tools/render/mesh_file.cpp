// Makes a mesh of the text of an OBJ file.
#include "render/mesh_file.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <map>
#include <span>
#include <stdexcept>
#include <string>

#include "vndf/io/atomic_file.h"
#include "vndf/io/format_error.h"

namespace vndf::render {
namespace {

constexpr std::uintmax_t kMostBytes = std::uintmax_t{512} << 20;
constexpr double kLeastHeight = 1e-7, kLeastSide = 1e-9;
/// A corner on a straight side is rounded in the file, so that a triangle may look back a little.
/// This share of the area of a face is not seen.
constexpr double kMostBackwards = 1e-3;
/// Sines below which a tangent is taken to run along the normal.
constexpr float kLeastSine = 1e-3f;

using Wide = Vec3<double>;

Wide side(const Vector& from, const Vector& to) {
  return {static_cast<double>(to.x) - static_cast<double>(from.x),
          static_cast<double>(to.y) - static_cast<double>(from.y),
          static_cast<double>(to.z) - static_cast<double>(from.z)};
}

/// Perpendicular to a triangle, and as long as twice its area.
Wide area_of(const Vector& a, const Vector& b, const Vector& c) {
  const Wide u = side(a, b), v = side(a, c);
  return {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
}

void add(Wide& sum, const Wide& a) {
  sum = {sum.x + a.x, sum.y + a.y, sum.z + a.z};
}

/// A sum over triangles as a unit vector, up where they cancel.
Vector direction(const Wide& sum) {
  const Wide unit = normalize_or_up(sum);
  return {static_cast<float>(unit.x), static_cast<float>(unit.y), static_cast<float>(unit.z)};
}

bool is_flat(const Vector& a, const Vector& b, const Vector& c) {
  const Wide area = area_of(a, b, c), ab = side(a, b), bc = side(b, c), ca = side(c, a);
  const double longest = std::max({dot(ab, ab), dot(bc, bc), dot(ca, ca)});
  return !(dot(area, area) > kLeastHeight * kLeastHeight * longest * longest);
}

Vector horizontal(const Vector& normal) {
  const Vector across = cross(Vector{0, 0, 1}, normal);
  return length(across) < kLeastSine ? Vector{1, 0, 0} : normalize_or_up(across);
}

/// Makes a vertex of each combination of indices.
class Builder {
 public:
  explicit Builder(const ObjText& obj) : obj_(obj) {}

  Mesh build() {
    for (const ObjText::Face& face : obj_.faces) add_face(face);
    check();
    add_normals();
    add_tangents();
    return std::move(mesh_);
  }

 private:
  using Corner = ObjText::Corner;
  using Triangle = std::array<Corner, 3>;

  /// Cuts a face into a fan from one of its first two corners. One of the two is right for every
  /// face of four corners, and both are for a convex face.
  void add_face(const ObjText::Face& face) {
    const auto corners = std::span(obj_.corners).subspan(face.first_corner, face.corners);
    for (std::size_t from = 0; from < 2; ++from)
      if (is_fan(corners, from)) {
        for (std::size_t k = 1; k + 1 < corners.size(); ++k) add_triangle(fan(corners, from, k));
        return;
      }
    throw io::FormatError("line " + std::to_string(face.line) + ": the face is not convex",
                          "triangulate the mesh when you export it");
  }

  static Triangle fan(std::span<const Corner> corners, std::size_t from, std::size_t k) {
    const std::size_t count = corners.size();
    return {corners[from], corners[(from + k) % count], corners[(from + k + 1) % count]};
  }

  /// Whether all triangles of a fan look to the side to which the whole face looks.
  bool is_fan(std::span<const Corner> corners, std::size_t from) const {
    Wide whole{0, 0, 0};
    const std::size_t last = corners.size() - 1;
    for (std::size_t k = 1; k < last; ++k) add(whole, area(fan(corners, from, k)));
    const double least = -kMostBackwards * dot(whole, whole);
    for (std::size_t k = 1; k < last; ++k)
      if (dot(whole, area(fan(corners, from, k))) < least) return false;
    return true;
  }

  const Vector& position(const Corner& corner) const { return obj_.positions[corner[0]]; }

  Wide area(const Triangle& t) const {
    return area_of(position(t[0]), position(t[1]), position(t[2]));
  }

  void add_triangle(const Triangle& t) {
    if (is_flat(position(t[0]), position(t[1]), position(t[2]))) return;
    mesh_.triangles.push_back({vertex(t[0]), vertex(t[1]), vertex(t[2])});
  }

  std::uint32_t vertex(const Corner& corner) {
    const auto [found, is_new] =
        vertices_.try_emplace(corner, static_cast<std::uint32_t>(corners_.size()));
    if (is_new) {
      corners_.push_back(corner);
      mesh_.positions.push_back(obj_.positions[corner[0]]);
    }
    return found->second;
  }

  void check() const {
    if (mesh_.triangles.empty())
      throw io::FormatError("it has no triangles with an area",
                            "give a Wavefront OBJ file with faces (lines f)");
    const auto extent = [&](float Vector::*axis) {
      const auto [least, most] = std::ranges::minmax_element(mesh_.positions, {}, axis);
      return static_cast<double>((*most).*axis) - static_cast<double>((*least).*axis);
    };
    if (std::max({extent(&Vector::x), extent(&Vector::y), extent(&Vector::z)}) < kLeastSide)
      throw io::FormatError("all of it is within 1e-9", "scale the mesh up");
  }

  Wide area(const std::array<std::uint32_t, 3>& t) const {
    return area_of(mesh_.positions[t[0]], mesh_.positions[t[1]], mesh_.positions[t[2]]);
  }

  void add_normals() {
    std::vector<Wide> sums(obj_.positions.size());
    for (const auto& triangle : mesh_.triangles)
      for (const std::uint32_t v : triangle) add(sums[corners_[v][0]], area(triangle));
    for (const Corner& corner : corners_)
      mesh_.normals.push_back(corner[2] == ObjText::kNone ? direction(sums[corner[0]])
                                                          : obj_.normals[corner[2]]);
  }

  void add_tangents() {
    std::vector<Wide> sums(corners_.size());
    for (const auto& triangle : mesh_.triangles)
      for (const std::uint32_t v : triangle) add(sums[v], along_texture(triangle));
    for (std::size_t v = 0; v < corners_.size(); ++v) {
      const Vector& normal = mesh_.normals[v];
      const Vector along = direction(sums[v]);
      const bool usable = dot(sums[v], sums[v]) > 0 && length(cross(along, normal)) >= kLeastSine;
      mesh_.tangents.push_back(usable ? along : horizontal(normal));
    }
  }

  /// The direction in which the first texture coordinate of a triangle grows, as long as twice its
  /// area; zero if it has no texture coordinates, or they have no area.
  Wide along_texture(const std::array<std::uint32_t, 3>& t) const {
    std::array<Vec2<double>, 3> place;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t index = corners_[t[k]][1];
      if (index == ObjText::kNone) return {0, 0, 0};
      place[k] = {static_cast<double>(obj_.places[index].x),
                  static_cast<double>(obj_.places[index].y)};
    }
    const double du1 = place[1].x - place[0].x, dv1 = place[1].y - place[0].y;
    const double du2 = place[2].x - place[0].x, dv2 = place[2].y - place[0].y;
    const double turn = du1 * dv2 - du2 * dv1;
    if (turn == 0) return {0, 0, 0};
    const Wide e1 = side(mesh_.positions[t[0]], mesh_.positions[t[1]]);
    const Wide e2 = side(mesh_.positions[t[0]], mesh_.positions[t[2]]);
    const double s1 = turn > 0 ? dv2 : -dv2, s2 = turn > 0 ? dv1 : -dv1;
    const Wide along{s1 * e1.x - s2 * e2.x, s1 * e1.y - s2 * e2.y, s1 * e1.z - s2 * e2.z};
    const Wide size = area(t);
    const double scale = std::sqrt(dot(size, size) / dot(along, along));
    return {scale * along.x, scale * along.y, scale * along.z};
  }

  const ObjText& obj_;
  Mesh mesh_;
  std::vector<Corner> corners_;  // of each vertex
  std::map<Corner, std::uint32_t> vertices_;
};

std::string text_of(const std::filesystem::path& path) {
  io::require_file(path);
  const std::uintmax_t bytes = std::filesystem::file_size(path);
  if (bytes > kMostBytes)
    throw io::FormatError("it has more than 512 MiB", "give a mesh of fewer triangles");
  std::string text(bytes, '\0');
  if (!std::ifstream(path, std::ios::binary).read(text.data(), static_cast<std::streamsize>(bytes)))
    throw io::FormatError("it cannot be read", "check its permissions");
  return text;
}

}  // namespace

Mesh mesh_of(const ObjText& obj) {
  return Builder(obj).build();
}

Mesh read_obj(const std::filesystem::path& path) try {
  return mesh_of(parse_obj(text_of(path)));
} catch (const io::FormatError& error) {
  throw std::runtime_error(path.string() + ": " + error.what());
}

}  // namespace vndf::render
