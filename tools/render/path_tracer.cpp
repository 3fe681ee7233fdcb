// Path tracing.
#include "render/path_tracer.h"

#include <algorithm>

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

/// Whether the smoothed and the true surface agree on which side `wo` leaves. If they do not, light
/// would leak through the body.
bool same_side(const Frame& frame, const Hit& hit, const Vector& wo) {
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
    if (!hit || on_lamp(*hit)) return sum;
    const Point point = point_at(*hit, path);
    if (sample_lights_) sum += sampled_light(path, point, numbers);
    if (!scatter(path, point, numbers)) return sum;
    if (!survives(path.throughput, points, numbers.next())) return sum;
  }
}

/// The light of the surroundings or of the lamp that the path has run into.
Rgb PathTracer::found_light(const Path& path, const std::optional<Hit>& hit) const {
  if (hit && !on_lamp(*hit)) return {};
  const Vector& w = path.ray.direction;
  const LightSample light =
      hit ? lights_.toward_lamp(w, hit->distance) : lights_.toward_environment(w);
  return weight(path.pdf, light.pdf) * path.throughput * light.radiance;
}

/// The point of a body that the path has run into. Where the smoothed normal faces away from the
/// path and the triangle does not, the triangle's normal is taken.
PathTracer::Point PathTracer::point_at(const Hit& hit, const Path& path) const {
  const Vector wi = -path.ray.direction;
  const bool agree = (dot(hit.normal, wi) > 0) == (dot(hit.face, wi) > 0);
  const Frame frame = Frame::around(agree ? hit.normal : hit.face, hit.tangent);
  return {*scene_.bodies[hit.mesh].material, hit, frame, frame.to_local(wi)};
}

/// The light that comes to the point straight from a light.
Rgb PathTracer::sampled_light(const Path& path, const Point& point, SampleSequence& numbers) const {
  const auto& [material, hit, frame, wi] = point;
  const float choice = numbers.next();
  const LightSample light = lights_.sample(hit.position, choice, numbers.next_pair());
  if (!(light.pdf > 0) || dark(light.radiance) || !same_side(frame, hit, light.wo)) return {};
  const Vector wo = frame.to_local(light.wo);
  const Rgb f = material.evaluate(wi, wo);
  constexpr float kBeforeLamp = 0.999f;
  if (dark(f) ||
      tracer_.blocked(leaving(hit.position, hit.face, light.wo), kBeforeLamp * light.distance))
    return {};
  return weight(light.pdf, material.pdf(wi, wo)) / light.pdf * path.throughput * f * light.radiance;
}

/// Lets the path go on from the point. Returns false if its light is lost there.
bool PathTracer::scatter(Path& path, const Point& point, SampleSequence& numbers) {
  const auto& [material, hit, frame, wi] = point;
  const Vec2<float> u = numbers.next_pair();
  const Scattered drawn = material.sample(wi, u, numbers.next());
  const Vector wo = normalize_or_up(frame.to_world(drawn.wo));
  if (dark(drawn.weight) || !same_side(frame, hit, wo)) return false;
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
