// The scenes that the program renders. They show what a distribution looks like, and where the
// sampling of normals matters (Heitz and d'Eon 2014, Figures 1, 2 and 9).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "render/scene.h"
#include "render/surface.h"

namespace vndf::render {

/// The refractive index of glass over that of air.
struct Glass {
  float eta = 1.5f;
};
using Substance = std::variant<ConductorFresnel<float, 3>, Glass>;

/// What can be chosen in every scene. What is not chosen is the scene's own.
struct SceneChoices {
  std::optional<Alpha<float>> alpha = {};
  std::optional<Substance> substance = {};
  std::optional<Environment> environment = {};
};

struct NamedScene {
  std::string name;
  std::string description;  ///< for people, in a line
};

/// The scenes of make_scene().
const std::vector<NamedScene>& named_scenes();

/// A scene by its name, with the roughness of `surface`. Throws std::invalid_argument for an
/// unknown name, with the nearest known one.
Scene make_scene(const std::string& name, const Surface& surface, const SceneChoices& choices);

/// `mesh`, scaled to the size of the ball and put in its place.
Scene make_scene(Mesh mesh, const Surface& surface, const SceneChoices& choices);

}  // namespace vndf::render
