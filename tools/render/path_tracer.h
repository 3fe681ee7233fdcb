// Path tracing: the radiance that a ray brings to the camera is estimated along one random path of
// any length (Kajiya 1986). At each point the path goes on in a direction that the material draws,
// and light is also sampled directly; the two estimates are combined by the power heuristic
// (Veach 1997, section 9.2.4).
#pragma once

#include "render/frame.h"
#include "render/lights.h"
#include "render/ray_tracer.h"
#include "render/sample_sequence.h"
#include "render/scene.h"

namespace vndf::render {

/// Traces paths in a scene, which must outlive this object. It can be asked from several threads at
/// once.
class PathTracer {
 public:
  /// Without `sample_lights` paths find light by themselves only. Throws what RayTracer throws.
  PathTracer(const Scene& scene, bool sample_lights);

  /// An unbiased estimate of the radiance that comes to the origin of `ray` along it.
  Rgb radiance(Ray ray, SampleSequence& numbers) const;

 private:
  /// The ray on which a path goes on, the share of what comes along it that reaches the camera, and
  /// the density with which a material drew it, 0 if none did.
  struct Path {
    Ray ray;
    Rgb throughput{1, 1, 1};
    float pdf = 0;
  };
  /// Where a path meets a body, as its material sees it: `wi` is in the shading frame.
  struct Point {
    const Material& material;
    const Hit& hit;
    Frame frame;
    Vector wi;
  };

  bool on_lamp(const Hit& hit) const { return hit.mesh >= scene_.bodies.size(); }
  Rgb found_light(const Path& path, const std::optional<Hit>& hit) const;
  Point point_at(const Hit& hit, const Path& path) const;
  Rgb sampled_light(const Path& path, const Point& point, SampleSequence& numbers) const;
  static bool scatter(Path& path, const Point& point, SampleSequence& numbers);
  float weight(float pdf, float other) const;

  const Scene& scene_;
  Lights lights_;
  bool sample_lights_;
  Mesh lamp_;
  RayTracer tracer_;
};

}  // namespace vndf::render
