// Path tracing.
#include "render/path_tracer.h"

#include <algorithm>

#include "render/frame.h"

namespace vndf::render {
namespace {

/// Shorter paths are not ended by roulette, because they carry most of the light.
constexpr int kCertainPoints = 4;
/// Longer paths go on with a chance of at most kMostSurvival even if nothing was lost on the way,
/// so that none is endless.
constexpr int kLongPath = 1024;
constexpr float kMostSurvival = 0.95f;

std::vector<const Mesh*> meshes_of(const Scene& scene, const Mesh& lamp) {
  std::vector<const Mesh*> meshes;
  for (const Body& body : scene.bodies) meshes.push_back(&body.mesh);
  if (scene.lamp) meshes.push_back(&lamp);
  return meshes;
}

/// The frame in which the material at `hit` sees light, for a path that comes from `wi`. Where the
/// smoothed normal faces away and the triangle does not, it is the triangle's.
Frame frame_of(const Hit& hit, const Vector& wi) {
  const bool agree = (dot(hit.normal, wi) > 0) == (dot(hit.face, wi) > 0);
  return Frame::around(agree ? hit.normal : hit.face, hit.tangent);
}

/// Whether the smoothed and the true surface agree on which side `wo` leaves. If they do not, light
/// would leak through the body.
bool same_side(const Hit& hit, const Frame& frame, const Vector& wo) {
  return (dot(frame.z, wo) > 0) == (dot(hit.face, wo) > 0);
}

bool dark(const Rgb& c) {
  return !(c.r > 0 || c.g > 0 || c.b > 0);
}

/// Russian roulette for a path of `points` points: ends it, or makes up for those that end. The
/// less light a path carries, the sooner it ends. Returns false if it ends.
bool survives(Rgb& throughput, int points, float u) {
  if (points < kCertainPoints) return true;
  const float most = points < kLongPath ? 1 : kMostSurvival;
  const float chance = std::min(most, std::max({throughput.r, throughput.g, throughput.b}));
  if (!(u < chance)) return false;
  throughput = (1 / chance) * throughput;
  return true;
}

}  // namespace

PathTracer::PathTracer(const Scene& scene, bool sample_lights)
    : scene_(scene),
      lights_(scene),
      sample_lights_(sample_lights),
      lamp_(scene.lamp ? rectangle(scene.lamp->corner, scene.lamp->x, scene.lamp->y) : Mesh{}),
      tracer_(meshes_of(scene, lamp_)) {}

Rgb PathTracer::radiance(Ray ray, SampleSequence& numbers) const {
  Rgb sum;
  Path path{ray};
  for (int points = 1;; ++points) {
    const std::optional<Hit> hit = tracer_.nearest(path.ray);
    sum += found_light(path, hit);
    if (!hit || hit->mesh >= scene_.bodies.size()) return sum;
    if (sample_lights_) sum += sampled_light(path, *hit, numbers);
    if (!scatter(path, *hit, numbers)) return sum;
    if (!survives(path.throughput, points, numbers.next())) return sum;
  }
}

/// The light of the surroundings or of the lamp that the path has run into.
Rgb PathTracer::found_light(const Path& path, const std::optional<Hit>& hit) const {
  const Vector& w = path.ray.direction;
  if (!hit)
    return weight(path.pdf, lights_.environment_pdf(w)) * path.throughput *
           scene_.environment.radiance(w);
  if (hit->mesh < scene_.bodies.size()) return {};
  return weight(path.pdf, lights_.lamp_pdf(w, hit->distance)) * path.throughput *
         lights_.lamp_radiance(w);
}

/// The light that comes to `hit` straight from a light.
Rgb PathTracer::sampled_light(const Path& path, const Hit& hit, SampleSequence& numbers) const {
  const float choice = numbers.next();
  const LightSample light = lights_.sample(hit.position, choice, numbers.next_pair());
  if (!(light.pdf > 0) || dark(light.radiance)) return {};
  const Vector wi = -path.ray.direction;
  const Frame frame = frame_of(hit, wi);
  if (!same_side(hit, frame, light.wo)) return {};
  const Material& material = *scene_.bodies[hit.mesh].material;
  const Vector local_wi = frame.to_local(wi), local_wo = frame.to_local(light.wo);
  const Rgb f = material.evaluate(local_wi, local_wo);
  constexpr float kBeforeLamp = 0.999f;
  if (dark(f) ||
      tracer_.blocked(leaving(hit.position, hit.face, light.wo), kBeforeLamp * light.distance))
    return {};
  const float pdf = material.pdf(local_wi, local_wo);
  return weight(light.pdf, pdf) / light.pdf * path.throughput * f * light.radiance;
}

/// Lets the path go on from `hit`. Returns false if its light is lost there.
bool PathTracer::scatter(Path& path, const Hit& hit, SampleSequence& numbers) const {
  const Vector wi = -path.ray.direction;
  const Frame frame = frame_of(hit, wi);
  const Vec2<float> u = numbers.next_pair();
  const Scattered drawn =
      scene_.bodies[hit.mesh].material->sample(frame.to_local(wi), u, numbers.next());
  if (dark(drawn.weight)) return false;
  const Vector wo = normalize_or_up(frame.to_world(drawn.wo));
  if (!same_side(hit, frame, wo)) return false;
  path = {leaving(hit.position, hit.face, wo), path.throughput * drawn.weight, drawn.pdf};
  return true;
}

/// The power heuristic for a sample that was drawn with the density `pdf` where the other way would
/// have drawn it with `other`. A direction that no other way finds has the weight 1.
float PathTracer::weight(float pdf, float other) const {
  if (!sample_lights_ || !(pdf > 0)) return 1;
  const float ratio = other / pdf;
  return 1 / (1 + ratio * ratio);
}

}  // namespace vndf::render
