// Light that reaches a point directly, as next-event estimation samples it: from the surroundings,
// and from the lamp where a scene has one.
#pragma once

#include <limits>

#include "render/scene.h"

namespace vndf::render {

/// A direction in which there is light, if nothing is in between.
struct LightSample {
  Vector wo;
  Rgb radiance;
  float pdf;       ///< per solid angle
  float distance;  ///< to the light
};

/// Samples the light of a scene, which must outlive this object.
class Lights {
 public:
  explicit Lights(const Scene& scene) : scene_(scene) {}

  /// Draws a light by `choice`, and a direction to it by `u`, all in [0, 1).
  LightSample sample(const Vector& position, float choice, const Vec2<float>& u) const {
    if (choice < chance_of_environment()) {
      const auto drawn = scene_.environment.sample(u.x, u.y);
      return {drawn.w, drawn.radiance, chance_of_environment() * drawn.pdf,
              std::numeric_limits<float>::infinity()};
    }
    const Lamp& lamp = *scene_.lamp;
    const Vector way = lamp.corner + u.x * lamp.x + u.y * lamp.y - position;
    const float distance = length(way);
    const Vector wo = (1 / distance) * way;
    return {wo, lamp_radiance(wo), lamp_pdf(wo, distance), distance};
  }

  /// Density of sample() for a direction to the surroundings, and for one to a point of the lamp at
  /// `distance`.
  float environment_pdf(const Vector& wo) const {
    return chance_of_environment() * scene_.environment.pdf(wo);
  }
  float lamp_pdf(const Vector& wo, float distance) const {
    const Vector normal = cross(scene_.lamp->x, scene_.lamp->y);  // as long as the area is large
    const float seen = -dot(wo, normal);
    return seen > 0 ? (1 - chance_of_environment()) * distance * distance / seen : 0;
  }

  /// The radiance of the lamp that comes from the direction `wo`.
  Rgb lamp_radiance(const Vector& wo) const {
    const Lamp& lamp = *scene_.lamp;
    return dot(wo, cross(lamp.x, lamp.y)) < 0 ? lamp.radiance : Rgb{};
  }

 private:
  float chance_of_environment() const { return scene_.lamp ? 0.5f : 1.0f; }

  const Scene& scene_;
};

}  // namespace vndf::render
