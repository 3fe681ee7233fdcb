// Rays by Embree.
#include "render/ray_tracer.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>
#include <string>

namespace vndf::render {
namespace {

RTCRayHit embree_ray(const Ray& ray, float distance) {
  RTCRayHit query{};
  query.ray.org_x = ray.origin.x;
  query.ray.org_y = ray.origin.y;
  query.ray.org_z = ray.origin.z;
  query.ray.dir_x = ray.direction.x;
  query.ray.dir_y = ray.direction.y;
  query.ray.dir_z = ray.direction.z;
  query.ray.tfar = distance;
  query.ray.mask = std::numeric_limits<unsigned>::max();
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return query;
}

#if RTC_VERSION_MAJOR >= 4
void intersect(RTCScene scene, RTCRayHit& query) {
  rtcIntersect1(scene, &query);
}
void occluded(RTCScene scene, RTCRay& ray) {
  rtcOccluded1(scene, &ray);
}
#else
void intersect(RTCScene scene, RTCRayHit& query) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene, &context, &query);
}
void occluded(RTCScene scene, RTCRay& ray) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene, &context, &ray);
}
#endif

/// The value between those of the three corners at the barycentric coordinates u and v.
Vector between(const std::vector<Vector>& values, const std::array<std::uint32_t, 3>& corners,
               float u, float v) {
  return (1 - u - v) * values[corners[0]] + u * values[corners[1]] + v * values[corners[2]];
}

}  // namespace

struct RayTracer::Embree {
  RTCDevice device = rtcNewDevice("threads=1");
  RTCScene scene = device == nullptr ? nullptr : rtcNewScene(device);
  std::vector<const Mesh*> meshes;

  Embree() = default;
  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;
  ~Embree() {
    if (scene != nullptr) rtcReleaseScene(scene);
    if (device != nullptr) rtcReleaseDevice(device);
  }

  /// Embree reads the arrays of the mesh where they are, in whole vectors of 16 bytes, so positions
  /// are copied.
  void add(const Mesh& mesh) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    void* positions =
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                sizeof(Vector), mesh.positions.size());
    void* triangles = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                              sizeof(mesh.triangles[0]), mesh.triangles.size());
    if (positions == nullptr || triangles == nullptr) {
      rtcReleaseGeometry(geometry);
      throw std::runtime_error("Embree cannot hold a mesh of " +
                               std::to_string(mesh.triangles.size()) + " triangles");
    }
    std::copy(mesh.positions.begin(), mesh.positions.end(), static_cast<Vector*>(positions));
    std::copy(mesh.triangles.begin(), mesh.triangles.end(),
              static_cast<std::array<std::uint32_t, 3>*>(triangles));
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    meshes.push_back(&mesh);
  }
};

RayTracer::RayTracer(const std::vector<const Mesh*>& meshes) : embree_(new Embree) {
  if (embree_->scene == nullptr) throw std::runtime_error("Embree cannot be started");
  for (const Mesh* mesh : meshes) embree_->add(*mesh);
  rtcCommitScene(embree_->scene);
  if (rtcGetDeviceError(embree_->device) != RTC_ERROR_NONE)
    throw std::runtime_error("Embree cannot hold the scene");
}
RayTracer::~RayTracer() = default;
RayTracer::RayTracer(RayTracer&&) noexcept = default;
RayTracer& RayTracer::operator=(RayTracer&&) noexcept = default;

std::optional<Hit> RayTracer::nearest(const Ray& ray) const {
  RTCRayHit query = embree_ray(ray, std::numeric_limits<float>::infinity());
  intersect(embree_->scene, query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  const Mesh& mesh = *embree_->meshes[query.hit.geomID];
  const auto& corners = mesh.triangles[query.hit.primID];
  const float u = query.hit.u, v = query.hit.v;
  const Vector &a = mesh.positions[corners[0]], &b = mesh.positions[corners[1]],
               &c = mesh.positions[corners[2]];
  const Vector face = normalize_or_up(cross(b - a, c - a));
  const Vector normal = normalize_or_up(between(mesh.normals, corners, u, v));
  return Hit{.mesh = query.hit.geomID,
             .distance = query.ray.tfar,
             .position = between(mesh.positions, corners, u, v),
             .face = dot(face, normal) < 0 ? -face : face,
             .normal = normal,
             .tangent = between(mesh.tangents, corners, u, v)};
}

bool RayTracer::blocked(const Ray& ray, float distance) const {
  RTCRay query = embree_ray(ray, distance).ray;
  occluded(embree_->scene, query);
  return query.tfar < 0;  // Embree's mark
}

}  // namespace vndf::render
