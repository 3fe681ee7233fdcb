// What is rendered: bodies, a lamp, the surroundings, and a camera that looks at them.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "render/camera.h"
#include "render/environment.h"
#include "render/material.h"
#include "render/mesh.h"

namespace vndf::render {

struct Body {
  Mesh mesh;
  std::shared_ptr<const Material> material;
};

/// A rectangle with a corner and two sides, which emits the same radiance in all directions from
/// the face that looks along the cross product of its sides.
struct Lamp {
  Vector corner, x, y;
  Rgb radiance;
};

struct Scene {
  Camera camera;
  Environment environment;
  std::vector<Body> bodies;
  std::optional<Lamp> lamp = {};
};

}  // namespace vndf::render
