// Where rays meet the triangles of a scene, by Embree (version 3 or 4).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "render/mesh.h"

namespace vndf::render {

struct Ray {
  Vector origin, direction;  ///< the direction is a unit vector
};

/// A point of a mesh.
struct Hit {
  std::uint32_t mesh;  ///< its place in the list that the ray tracer was made from
  float distance;
  Vector position;
  Vector face;     ///< unit normal of the triangle, on the side of `normal`
  Vector normal;   ///< unit normal between those of the corners
  Vector tangent;  ///< between those of the corners
};

/// Finds triangles. It can be asked from several threads at once.
class RayTracer {
 public:
  /// `meshes` must outlive this object. Throws std::runtime_error if Embree fails.
  explicit RayTracer(const std::vector<const Mesh*>& meshes);
  ~RayTracer();
  RayTracer(RayTracer&&) noexcept;
  RayTracer& operator=(RayTracer&&) noexcept;

  /// The nearest point that the ray meets.
  std::optional<Hit> nearest(const Ray& ray) const;

  /// Whether anything is on the ray before `distance`, which may be infinite.
  bool blocked(const Ray& ray, float distance) const;

 private:
  struct Embree;
  std::unique_ptr<Embree> embree_;
};

/// Where a ray begins that leaves `position` for `direction`: a little off the face with the normal
/// `face`, on the side of the direction, so that rounding does not let the ray meet the face again.
/// The distance suits scenes a few units large.
inline Ray leaving(const Vector& position, const Vector& face, const Vector& direction) {
  constexpr float kOffset = 1e-4f;
  return {position + (dot(face, direction) < 0 ? -kOffset : kOffset) * face, direction};
}

}  // namespace vndf::render
