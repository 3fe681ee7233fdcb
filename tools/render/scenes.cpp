// The scenes that the program renders.
#include "render/scenes.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "render/metals.h"
#include "vndf/support/text.h"

namespace vndf::render {
namespace {

/// What a scene takes where nothing is chosen.
struct Defaults {
  Alpha<float> alpha;
  Substance substance;
};

std::shared_ptr<const Material> material_of(const Surface& surface, const SceneChoices& choices,
                                            const Defaults& defaults) {
  const Alpha<float> alpha = choices.alpha.value_or(defaults.alpha);
  const Substance substance = choices.substance.value_or(defaults.substance);
  if (const auto* glass = std::get_if<Glass>(&substance)) return surface.glass(alpha, glass->eta);
  return surface.metal(alpha, std::get<ConductorFresnel<float, 3>>(substance));
}

const ConductorFresnel<float, 3>& metal(const std::string& name) {
  return std::ranges::find_if(kMetals, [&](const Metal& m) { return m.name == name; })->fresnel;
}

/// A slab of glass that is rough on all faces.
Scene slab(const Surface& surface, const SceneChoices& choices, const Alpha<float>& alpha,
           const Environment& environment, const Camera& camera) {
  return {.camera = camera,
          .environment = choices.environment.value_or(environment),
          .bodies = {{box({-1, -1, -0.1f}, {1, 1, 0.1f}),
                      material_of(surface, choices, {alpha, Glass{}})}}};
}

Scene plate(const Surface& surface, const SceneChoices& choices) {
  return slab(surface, choices, {0.05f, 0.4f}, Environment::constant({1, 1, 1}),
              {.position = {-1.3f, -3.6f, 2.1f}, .target = {0, 0, -0.05f}, .degrees = 40});
}

/// It is seen from low above, because grazing incidence is where sampling all normals is worst.
Scene plate_beckmann(const Surface& surface, const SceneChoices& choices) {
  return slab(surface, choices, {0.1f, 0.1f}, Environment::sky(),
              {.position = {-1, -3.8f, 0.6f}, .target = {0, 0, -0.05f}, .degrees = 36});
}

Body ground() {
  return {rectangle({-1000, -1000, 0}, {2000, 0, 0}, {0, 2000, 0}),
          std::make_shared<Matt>(Rgb{0.2f, 0.2f, 0.2f})};
}

/// A turned foot with a ball on it.
Mesh foot() {
  std::vector<Vec2<float>> profile{{0.9f, 0},     {0.9f, 0.12f},  {0.8f, 0.2f},   {0.62f, 0.24f},
                                   {0.5f, 0.32f}, {0.42f, 0.45f}, {0.38f, 0.65f}, {0.38f, 0.85f},
                                   {0.42f, 1.0f}, {0.5f, 1.1f},   {0.62f, 1.16f}, {0.62f, 1.26f},
                                   {0, 1.26f}};
  return revolved(profile);
}

Scene pedestal(const Surface& surface, const SceneChoices& choices) {
  const auto material = material_of(surface, choices, {{0.05f, 0.05f}, metal("copper")});
  return {
      .camera = {.position = {0, -5.2f, 2.2f}, .target = {0, 0, 1.05f}, .degrees = 36},
      .environment = choices.environment.value_or(Environment::sky()),
      .bodies = {ground(), {foot(), material}, {revolved(half_circle(0.55f, 1.80f)), material}}};
}

/// `mesh` on the ground, between the sky and a lamp.
Scene studio(Mesh mesh, const Surface& surface, const SceneChoices& choices) {
  const auto material = material_of(surface, choices, {{0.3f, 0.3f}, metal("gold")});
  return {.camera = {.position = {0, -5.4f, 1.9f}, .target = {0, 0, 1}, .degrees = 30},
          .environment = choices.environment.value_or(Environment::sky()),
          .bodies = {ground(), {std::move(mesh), material}},
          .lamp = Lamp{{1.6f, -3.2f, 1.2f}, {0, 0, 1.6f}, {0.9f, 0.9f, 0}, {12, 12, 12}}};
}

Scene ball(const Surface& surface, const SceneChoices& choices) {
  return studio(revolved(half_circle(1, 1)), surface, choices);
}

struct Maker {
  NamedScene text;
  Scene (*make)(const Surface&, const SceneChoices&);
};

const std::vector<Maker>& makers() {
  static const std::vector<Maker> list{
      {{"plate", "a slab of rough glass in white surroundings, alpha 0.05 x 0.4 (Figure 1)"},
       plate},
      {{"plate-beckmann", "the same slab under a sky, alpha 0.1 (Figure 9)"}, plate_beckmann},
      {{"pedestal", "a rough metal under a sky, alpha 0.05 (Figures 2 and 10)"}, pedestal},
      {{"ball", "a ball on the ground between a sky and a lamp, gold with alpha 0.3"}, ball},
  };
  return list;
}

}  // namespace

const std::vector<NamedScene>& named_scenes() {
  static const std::vector<NamedScene> list = [] {
    std::vector<NamedScene> texts;
    for (const Maker& maker : makers()) texts.push_back(maker.text);
    return texts;
  }();
  return list;
}

Scene make_scene(const std::string& name, const Surface& surface, const SceneChoices& choices) {
  std::vector<std::string> known;
  for (const Maker& maker : makers()) {
    if (maker.text.name == name) return maker.make(surface, choices);
    known.push_back(maker.text.name);
  }
  throw std::invalid_argument("'" + name + "' is neither a scene nor an .obj file" +
                              support::did_you_mean(name, known) +
                              "; known scenes: " + support::listed(known));
}

Scene make_scene(Mesh mesh, const Surface& surface, const SceneChoices& choices) {
  constexpr float kFar = std::numeric_limits<float>::max();
  Vector low{kFar, kFar, kFar}, high{-kFar, -kFar, -kFar};
  for (const Vector& p : mesh.positions) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const Vector size = high - low;
  const float scale = 2 / std::max({size.x, size.y, size.z});
  const Vector foot{(low.x + high.x) / 2, (low.y + high.y) / 2, low.z};
  for (Vector& p : mesh.positions) p = scale * (p - foot);
  return studio(std::move(mesh), surface, choices);
}

}  // namespace vndf::render
