// The shapes of the scenes: closed, with normals that look outwards.
#include "render/mesh.h"

#include <cmath>
#include <map>
#include <numbers>
#include <tuple>
#include <utility>

#include "support/catch.h"

using namespace vndf;
using namespace vndf::render;

namespace {

/// Corners are compared by where they are, because faces do not share vertices.
using Place = std::tuple<long, long, long>;

Place place(const Vector& p) {
  const auto rounded = [](float x) { return std::lround(static_cast<double>(x) * 1e5); };
  return {rounded(p.x), rounded(p.y), rounded(p.z)};
}

/// Whether each edge is passed once in each direction, as on a closed surface whose triangles all
/// turn the same way.
bool closed(const Mesh& mesh) {
  std::map<std::pair<Place, Place>, int> passed;
  for (const auto& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const Place a = place(mesh.positions[t[i]]), b = place(mesh.positions[t[(i + 1) % 3]]);
      ++passed[{a, b}];
      --passed[{b, a}];
    }
  for (const auto& [edge, count] : passed)
    if (count != 0) return false;
  return true;
}

/// By the divergence theorem, positive if triangles turn left seen from outside.
double volume(const Mesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles)
    sum += static_cast<double>(
        dot(mesh.positions[t[0]], cross(mesh.positions[t[1]], mesh.positions[t[2]])));
  return sum / 6;
}

/// Whether normals look the way that triangles turn, and tangents lie along the surface.
void check_frames(const Mesh& mesh) {
  for (const auto& t : mesh.triangles) {
    const Vector face = normalize_or_up(cross(mesh.positions[t[1]] - mesh.positions[t[0]],
                                              mesh.positions[t[2]] - mesh.positions[t[0]]));
    for (const auto corner : t) {
      REQUIRE(length(mesh.normals[corner]) == Approx(1).margin(1e-5));
      REQUIRE(dot(mesh.normals[corner], face) > 0.8f);
      REQUIRE(std::abs(dot(mesh.normals[corner], normalize_or_up(mesh.tangents[corner]))) < 1e-5f);
    }
  }
}

}  // namespace

TEST_CASE("a box is closed, has its volume, and its normals look outwards", "[render]") {
  const Mesh mesh = box({-1, -2, 0}, {2, 1, 0.5f});
  CHECK(mesh.triangles.size() == 12);
  CHECK(closed(mesh));
  CHECK(volume(mesh) == Approx(4.5));
  check_frames(mesh);
}

TEST_CASE("a ball is closed, and its normals are those of a sphere", "[render]") {
  const Mesh mesh = revolved(half_circle(0.5f, 2));
  CHECK(closed(mesh));
  // The volume of the ball but for what its facets cut off.
  CHECK(volume(mesh) == Approx(std::numbers::pi / 6).epsilon(1e-3));
  check_frames(mesh);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Vector out = 2 * (mesh.positions[i] - Vector{0, 0, 2});
    REQUIRE(length(mesh.normals[i] - out) < 1e-4f);
  }
}

TEST_CASE("a profile keeps its sharp corners and smooths the others", "[render]") {
  // A cylinder with a cap, and a cone that is nearly one.
  const Mesh cylinder = revolved({{1, 0}, {1, 1}, {0, 1}});
  for (std::size_t i = 0; i < cylinder.positions.size(); ++i) {
    const Vector& n = cylinder.normals[i];
    REQUIRE((n.z == Approx(1).margin(1e-6) || n.z == Approx(0).margin(1e-6)));
  }
  const Mesh bent = revolved({{1, 0}, {1, 1}, {0.9f, 2}});
  bool between = false;
  for (const Vector& n : bent.normals) between |= n.z > 0.04f && n.z < 0.06f;
  CHECK(between);
}

TEST_CASE("a moved mesh is the same elsewhere", "[render]") {
  const Mesh mesh = moved(box({0, 0, 0}, {1, 1, 1}), {3, 4, 5});
  CHECK(volume(mesh) == Approx(1).epsilon(1e-4));
  for (const Vector& p : mesh.positions) REQUIRE((p.x >= 3 && p.y >= 4 && p.z >= 5));
}
