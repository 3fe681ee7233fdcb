// The shapes that the scenes are made of.
#include "render/mesh.h"

#include <cmath>
#include <cstddef>
#include <numbers>

namespace vndf::render {
namespace {

/// So fine that the corners of a circle of radius 1 are within 2e-4 of it.
constexpr std::size_t kSegmentsAround = 192, kSegmentsOfHalfCircle = 96;
constexpr float kSmoothedCosine = 0.8660254f;  // of 30 degrees

void append(Mesh& mesh, const Mesh& other) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  const auto join = [](auto& to, const auto& from) {
    to.insert(to.end(), from.begin(), from.end());
  };
  join(mesh.positions, other.positions);
  join(mesh.normals, other.normals);
  join(mesh.tangents, other.tangents);
  for (const auto& t : other.triangles)
    mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
}

/// The unit normal of the step from `a` to `b`, to the right of it, which is outside.
Vec2<float> outside(const Vec2<float>& a, const Vec2<float>& b) {
  const float dx = b.x - a.x, dz = b.y - a.y, size = std::hypot(dx, dz);
  return {dz / size, -dx / size};
}

/// The normal at an end of a step with the normal `own`, beside a step with the normal `next`.
Vec2<float> smoothed(const Vec2<float>& own, const Vec2<float>& next) {
  if (own.x * next.x + own.y * next.y < kSmoothedCosine) return own;
  const float x = own.x + next.x, y = own.y + next.y, size = std::hypot(x, y);
  return {x / size, y / size};
}

/// The ring that one step of the profile sweeps.
void append_ring(Mesh& mesh, const std::array<Vec2<float>, 2>& ends,
                 const std::array<Vec2<float>, 2>& normals) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (std::size_t i = 0; i <= kSegmentsAround; ++i) {
    const float azimuth = static_cast<float>(i % kSegmentsAround) * 2 * std::numbers::pi_v<float> /
                          static_cast<float>(kSegmentsAround);
    const float c = std::cos(azimuth), s = std::sin(azimuth);
    for (std::size_t k = 0; k < 2; ++k) {
      mesh.positions.push_back({ends[k].x * c, ends[k].x * s, ends[k].y});
      mesh.normals.push_back({normals[k].x * c, normals[k].x * s, normals[k].y});
      mesh.tangents.push_back({-s, c, 0});
    }
  }
  for (std::uint32_t i = 0; i < kSegmentsAround; ++i) {
    const std::uint32_t at = first + 2 * i;
    if (ends[0].x > 0) mesh.triangles.push_back({at, at + 2, at + 1});
    if (ends[1].x > 0) mesh.triangles.push_back({at + 1, at + 2, at + 3});
  }
}

}  // namespace

Mesh rectangle(const Vector& corner, const Vector& x, const Vector& y) {
  Mesh mesh;
  mesh.positions = {corner, corner + x, corner + x + y, corner + y};
  mesh.normals.assign(4, normalize_or_up(cross(x, y)));
  mesh.tangents.assign(4, x);
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

Mesh box(const Vector& low, const Vector& high) {
  const Vector d = high - low;
  const Vector x{d.x, 0, 0}, y{0, d.y, 0}, z{0, 0, d.z};
  Mesh mesh;
  append(mesh, rectangle(low + z, x, y));   // top
  append(mesh, rectangle(low + y, x, -y));  // bottom
  append(mesh, rectangle(low, x, z));       // front
  append(mesh, rectangle(low + y + z, x, -z));
  append(mesh, rectangle(low + x, y, z));
  append(mesh, rectangle(low + z, y, -z));
  return mesh;
}

Mesh revolved(const std::vector<Vec2<float>>& profile) {
  Mesh mesh;
  const std::size_t steps = profile.size() - 1;
  const auto normal = [&](std::size_t step) { return outside(profile[step], profile[step + 1]); };
  for (std::size_t i = 0; i < steps; ++i) {
    const Vec2<float> own = normal(i), mirrored{-own.x, own.y};
    // On the axis the neighbour is the same step on the other side.
    const Vec2<float> before = profile[i].x == 0 ? mirrored : i > 0 ? normal(i - 1) : own;
    const Vec2<float> after = profile[i + 1].x == 0 ? mirrored
                              : i + 1 < steps       ? normal(i + 1)
                                                    : own;
    append_ring(mesh, {profile[i], profile[i + 1]}, {smoothed(own, before), smoothed(own, after)});
  }
  return mesh;
}

std::vector<Vec2<float>> half_circle(float radius, float z) {
  std::vector<Vec2<float>> profile{{0, z - radius}};
  for (std::size_t i = 1; i < kSegmentsOfHalfCircle; ++i) {
    const float angle = static_cast<float>(i) * std::numbers::pi_v<float> /
                        static_cast<float>(kSegmentsOfHalfCircle);
    profile.push_back({radius * std::sin(angle), z - radius * std::cos(angle)});
  }
  profile.push_back({0, z + radius});
  return profile;
}

Mesh moved(Mesh mesh, const Vector& offset) {
  for (Vector& p : mesh.positions) p = p + offset;
  return mesh;
}

}  // namespace vndf::render
