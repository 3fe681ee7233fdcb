// The scenes of the paper, rendered with every way of drawing normals.
#include "report/scenes_experiment.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "render/render_image.h"
#include "render/scenes.h"
#include "vndf/distributions/specification.h"
#include "vndf/precompute/bake_certified.h"
#include "vndf/precompute/build_tables.h"

namespace vndf::tools {
namespace {

using render::Rendering;
using render::RenderOptions;
using render::Sampling;
using render::Scene;

struct FigurePlan {
  std::string name, title, setup;
  std::string scene, distribution, analytic;
  /// In place of those of the scene.
  std::optional<render::Environment> surroundings = {};
  bool sample_lights = true;
  /// The picture has a width of 1 / `smaller`, and `smaller`^2 times the samples.
  std::uint32_t smaller = 1;
};

/// The overcast sky of the CIE (Moon and Spencer 1942), (1 + 2 z) / 3, with a ground as bright as
/// the horizon. Under a sun, paths from the ground to it by way of the metal make most of the noise
/// of a pedestal, and differ by chance more than by how normals are drawn.
render::Environment overcast_sky() {
  constexpr std::size_t kRows = 128;
  render::Image image{1, kRows};
  for (std::size_t row = 0; row < kRows; ++row) {
    const double theta = std::numbers::pi * (static_cast<double>(row) + 0.5) / kRows;
    const auto grey = static_cast<float>((1 + 2 * std::max(0.0, std::cos(theta))) / 3);
    image.pixels.push_back({grey, grey, grey});
  }
  return render::Environment(std::move(image));
}

std::vector<FigurePlan> plans() {
  return {
      {.name = "plate",
       .title = "Figure 1: a plate of glass",
       .setup =
           "A slab with n = 1.5, rough on all faces with GGX slopes of alpha 0.05 x 0.4, in "
           "constant white surroundings. Directions are drawn by the surface and by the "
           "surroundings, and combined by multiple importance sampling. The paper shows it with 64 "
           "samples in 10.0 s for the previous method, and with 58 samples in 10.4 s for visible "
           "normals.",
       .scene = "plate",
       .distribution = "ggx",
       .analytic = "ggx-caps"},
      {.name = "pedestal-mis",
       .title = "Figure 2: a pedestal of metal",
       .setup = "A rough metal with GGX slopes of alpha 0.05 under an overcast sky. Directions are "
                "drawn by the surface and by the brightness of the sky, and combined by multiple "
                "importance sampling.",
       .scene = "pedestal",
       .distribution = "ggx",
       .analytic = "ggx-caps",
       .surroundings = overcast_sky()},
      {.name = "plate-beckmann",
       .title = "Figure 9: a plate of Beckmann slopes under a sun",
       .setup =
           "The slab with Beckmann slopes of alpha 0.1 under a sky with a sun, with many samples. "
           "A path that meets the sun by chance is bright by any method, and the weights of the "
           "previous method can make it brighter still.",
       .scene = "plate-beckmann",
       .distribution = "beckmann",
       .analytic = "beckmann-exact",
       .smaller = 2},
      {.name = "pedestal",
       .title = "Figure 10: the pedestal, light found by the surface alone",
       .setup =
           "The scene of Figure 2. Directions are drawn by the surface alone, so that the noise "
           "on the metal is that of its sampling.",
       .scene = "pedestal",
       .distribution = "ggx",
       .analytic = "ggx-caps",
       .surroundings = overcast_sky(),
       .sample_lights = false}};
}

/// Turns the progress of one rendering after another into that of all.
class WholeProgress {
 public:
  /// `total` is the sum of the `weight`s to come.
  WholeProgress(support::Workers workers, double total)
      : workers_(std::move(workers)), total_(total) {}

  /// Workers of the next piece of work, which takes a time in proportion to `weight`.
  support::Workers next(double weight) {
    const double begin = std::exchange(done_, done_ + weight);
    if (!workers_.progress) return workers_;
    return {workers_.threads, [this, begin, weight](std::size_t done, std::size_t count) {
              constexpr double kSteps = 1e6;
              const double share = static_cast<double>(done) / static_cast<double>(count);
              const double all = (begin + weight * share) / total_;
              workers_.progress(static_cast<std::size_t>(all * kSteps),
                                static_cast<std::size_t>(kSteps));
            }};
  }

 private:
  support::Workers workers_;
  double total_, done_ = 0;
};

/// The scene with each way of drawing normals.
using Scenes = std::array<Scene, kWays.size()>;

Scenes scenes_of(const FigurePlan& plan, const std::shared_ptr<const KernelTables>& tables) {
  const auto scene = [&](const std::shared_ptr<const render::Surface>& surface) {
    return render::make_scene(plan.scene, *surface, {.environment = plan.surroundings});
  };
  return {scene(render::tabulated_surface(tables, Sampling::previous)),
          scene(render::tabulated_surface(tables, Sampling::walter)),
          scene(render::tabulated_surface(tables, Sampling::visible)),
          scene(render::analytic_surface(plan.analytic, Sampling::visible))};
}

/// Renders the pictures of one figure.
class Studio {
 public:
  Studio(const FigurePlan& plan, Scenes scenes, const ScenesOptions& options,
         WholeProgress& progress)
      : plan_(plan), scenes_(std::move(scenes)), options_(options), progress_(progress) {}

  SceneFigure figure() {
    SceneFigure figure{plan_.name, plan_.title, plan_.setup, reference()};
    RenderOptions options = options_of(options_.samples);
    for (const Way way : kWays)
      figure.equal_samples[way] = rendering(way, options, figure.reference.image);
    options.seconds = figure.equal_samples[Way::visible].seconds;
    for (const Way way : kWays)
      figure.equal_time[way] = way == Way::visible
                                   ? figure.equal_samples[way]
                                   : rendering(way, options, figure.reference.image);
    return figure;
  }

 private:
  const Scene& scene(Way way) const { return scenes_[static_cast<std::size_t>(way)]; }

  RenderOptions options_of(std::uint32_t samples) const {
    const std::size_t side = options_.size / plan_.smaller;
    return {.width = side,
            .height = side,
            .samples = samples * plan_.smaller * plan_.smaller,
            .seed = options_.seed,
            .sample_lights = plan_.sample_lights};
  }

  SceneRendering rendering(Way way, RenderOptions options, const render::Image& reference) {
    options.workers = progress_.next(options_.samples);
    Rendering r = render::render(scene(way), options);
    const render::ImageError error = render::image_error(r.image, reference);
    return {std::move(r.image), r.samples, r.seconds, error};
  }

  /// The mean of two renderings by the analytic sampler with seeds of their own, so that its error
  /// is known and has nothing in common with that of the pictures. Light is sampled in any case,
  /// because less noise is better here.
  Reference reference() {
    RenderOptions options = options_of(options_.reference_samples / 2);
    options.sample_lights = true;
    std::array<Rendering, 2> halves;
    for (Rendering& half : halves) {
      ++options.seed;
      options.workers = progress_.next(0.5 * options_.reference_samples);
      half = render::render(scene(Way::analytic), options);
    }
    return {render::mean_of(halves[0].image, halves[1].image),
            halves[0].samples + halves[1].samples, halves[0].seconds + halves[1].seconds,
            render::error_of_mean(halves[0].image, halves[1].image)};
  }

  const FigurePlan& plan_;
  Scenes scenes_;
  const ScenesOptions& options_;
  WholeProgress& progress_;
};

/// What a figure takes, in samples of a pixel. Of the second comparison, one picture is that of the
/// first.
double weight_of_figure(const ScenesOptions& o) {
  return (2.0 * kWays.size() - 1) * o.samples + o.reference_samples;
}

}  // namespace

SceneTables bake_scene_tables(unsigned threads) {
  SceneTables tables;
  for (const FigurePlan& plan : plans()) {
    if (tables.contains(plan.distribution)) continue;
    const auto distribution = distributions::make_distribution({plan.distribution});
    const auto pair = precompute::build_tables(*distribution, {.threads = threads}).tables;
    tables[plan.distribution] =
        std::make_shared<const KernelTables>(precompute::bake_certified(*distribution, *pair));
  }
  return tables;
}

std::vector<SceneFigure> run_scenes_experiment(const SceneTables& tables,
                                               const ScenesOptions& options) {
  const std::vector<FigurePlan> all = plans();
  WholeProgress progress(options.workers,
                         static_cast<double>(all.size()) * weight_of_figure(options));
  std::vector<SceneFigure> figures;
  for (const FigurePlan& plan : all)
    figures.push_back(
        Studio(plan, scenes_of(plan, tables.at(plan.distribution)), options, progress).figure());
  return figures;
}

}  // namespace vndf::tools
