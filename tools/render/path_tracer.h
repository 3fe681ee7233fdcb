// Path tracing: the radiance that a ray brings to the camera is estimated along one random path of
// any length (Kajiya 1986). At each point the path goes on in a direction that the material draws,
// and light is also sampled directly; the two estimates are combined by the power heuristic
// (Veach 1997, section 9.2.4).
#pragma once

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
  /// Where a path is: the ray on which it goes on, the share of what that brings which reaches the
  /// camera, and the density with which the material drew it, 0 if it did not draw.
  struct Path {
    Ray ray;
    Rgb throughput{1, 1, 1};
    float pdf = 0;
  };

  Rgb found_light(const Path& path, const std::optional<Hit>& hit) const;
  Rgb sampled_light(const Path& path, const Hit& hit, SampleSequence& numbers) const;
  bool scatter(Path& path, const Hit& hit, SampleSequence& numbers) const;
  float weight(float pdf, float other) const;

  const Scene& scene_;
  Lights lights_;
  bool sample_lights_;
  Mesh lamp_;
  RayTracer tracer_;
};

}  // namespace vndf::render
