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
    if (choice < chance_of_environment()) return far(scene_.environment.sample(u.x, u.y));
    const Lamp& lamp = *scene_.lamp;
    const Vector way = lamp.corner + u.x * lamp.x + u.y * lamp.y - position;
    const float distance = length(way);
    return toward_lamp((1 / distance) * way, distance);
  }

  /// What sample() gives where it draws the direction `wo` to the surroundings, or to a point of
  /// the lamp at `distance`. The back of the lamp is dark, and is not drawn.
  LightSample toward_environment(const Vector& wo) const {
    return far(scene_.environment.toward(wo));
  }
  LightSample toward_lamp(const Vector& wo, float distance) const {
    const Vector normal = cross(scene_.lamp->x, scene_.lamp->y);  // as long as the area is large
    const float seen = -dot(wo, normal);
    if (!(seen > 0)) return {wo, Rgb{}, 0, distance};
    return {wo, scene_.lamp->radiance, (1 - chance_of_environment()) * distance * distance / seen,
            distance};
  }

 private:
  float chance_of_environment() const { return scene_.lamp ? 0.5f : 1.0f; }

  LightSample far(const Environment::Sample& drawn) const {
    return {drawn.w, drawn.radiance, chance_of_environment() * drawn.pdf,
            std::numeric_limits<float>::infinity()};
  }

  const Scene& scene_;
};

}  // namespace vndf::render
