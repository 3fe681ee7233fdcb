// The scenes of the paper, rendered with every way of drawing normals.
#include "report/scenes_experiment.h"

#include <memory>
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
  bool sample_lights;
};

/// A scene, and the figures that show it, which share a reference.
struct ScenePlan {
  std::string scene, distribution, analytic;
  /// Pictures have a width of 1 / `smaller`, and `smaller`^2 times the samples.
  std::uint32_t smaller;
  std::vector<FigurePlan> figures;
};

std::vector<ScenePlan> plans() {
  return {
      {"plate",
       "ggx",
       "ggx-caps",
       1,
       {{"plate", "Figure 1: a plate of glass",
         "A slab with n = 1.5, rough on all faces with GGX slopes of alpha 0.05 x 0.4, in constant "
         "white surroundings. Light is sampled by the surface and by the surroundings. The paper "
         "shows it with 64 samples in 10.0 s for the previous method, and with 58 samples in 10.4 "
         "s for visible normals.",
         true}}},
      {"plate-beckmann",
       "beckmann",
       "beckmann-exact",
       2,
       {{"plate-beckmann", "Figure 9: fireflies of a Beckmann surface",
         "The slab with Beckmann slopes of alpha 0.1, with many samples. What is bright after so "
         "many samples comes from few of them with large weights.",
         true}}},
      {"pedestal",
       "ggx",
       "ggx-caps",
       1,
       {{"pedestal", "Figures 2 and 10: a pedestal of metal, light found by the surface alone",
         "A rough metal with GGX slopes of alpha 0.05 under a sky. Directions are drawn by the "
         "surface only, so that the picture shows what its sampling is worth.",
         false},
        {"pedestal-mis", "Figures 2 and 10: the pedestal, light sampled directly too",
         "The same scene. Directions are also drawn by the brightness of the sky, and both are "
         "combined by multiple importance sampling, which hides much of what a surface samples "
         "badly.",
         true}}}};
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

std::shared_ptr<const KernelTables> baked(const std::string& name, unsigned threads) {
  const auto distribution = distributions::make_distribution({name});
  const auto pair = precompute::build_tables(*distribution, {.threads = threads}).tables;
  return std::make_shared<const KernelTables>(precompute::bake_certified(*distribution, *pair));
}

Scenes scenes_of(const ScenePlan& plan, unsigned threads) {
  const auto tables = baked(plan.distribution, threads);
  const auto scene = [&](const std::shared_ptr<const render::Surface>& surface) {
    return render::make_scene(plan.scene, *surface, {});
  };
  return {scene(render::tabulated_surface(tables, Sampling::previous)),
          scene(render::tabulated_surface(tables, Sampling::walter)),
          scene(render::tabulated_surface(tables, Sampling::visible)),
          scene(render::analytic_surface(plan.analytic, Sampling::visible))};
}

/// Renders the figures of one scene.
class SceneStudio {
 public:
  SceneStudio(const ScenePlan& plan, const ScenesOptions& options, WholeProgress& progress)
      : plan_(plan),
        options_(options),
        progress_(progress),
        scenes_(scenes_of(plan, options.workers.threads)),
        reference_(reference()) {}

  SceneFigure figure(const FigurePlan& plan) {
    SceneFigure figure{plan.name, plan.title, plan.setup, reference_};
    for (const Way way : kWays) figure.equal_samples[way] = rendering(way, samples_of(plan));
    RenderOptions timed = samples_of(plan);
    timed.seconds = figure.equal_samples[Way::visible].seconds;
    for (const Way way : kWays)
      figure.equal_time[way] =
          way == Way::visible ? figure.equal_samples[way] : rendering(way, timed);
    return figure;
  }

 private:
  const Scene& scene(Way way) const { return scenes_[static_cast<std::size_t>(way)]; }

  RenderOptions samples_of(const FigurePlan& plan) const {
    const std::size_t side = options_.size / plan_.smaller;
    return {.width = side,
            .height = side,
            .samples = options_.samples * plan_.smaller * plan_.smaller,
            .seed = options_.seed,
            .sample_lights = plan.sample_lights};
  }

  SceneRendering rendering(Way way, RenderOptions options) {
    options.workers = progress_.next(options_.samples);
    const Rendering r = render::render(scene(way), options);
    return {r.image, r.samples, r.seconds, render::image_error(r.image, reference_.image)};
  }

  /// The mean of two renderings by the analytic sampler with seeds of their own, so that its error
  /// is known and has nothing in common with that of the pictures.
  Reference reference() {
    RenderOptions options = samples_of(plan_.figures.back());
    options.samples = options_.reference_samples * plan_.smaller * plan_.smaller / 2;
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

  const ScenePlan& plan_;
  const ScenesOptions& options_;
  WholeProgress& progress_;
  Scenes scenes_;
  Reference reference_;
};

/// In samples of a pixel. Of the second comparison, one picture is that of the first.
double weight_of(const ScenePlan& plan, const ScenesOptions& o) {
  const auto pictures = static_cast<double>(plan.figures.size() * (2 * kWays.size() - 1));
  return pictures * o.samples + o.reference_samples;
}

}  // namespace

std::vector<SceneFigure> run_scenes_experiment(const ScenesOptions& options) {
  const std::vector<ScenePlan> all = plans();
  double total = 0;
  for (const ScenePlan& plan : all) total += weight_of(plan, options);
  WholeProgress progress(options.workers, total);
  std::vector<SceneFigure> figures;
  for (const ScenePlan& plan : all) {
    SceneStudio studio(plan, options, progress);
    for (const FigurePlan& figure : plan.figures) figures.push_back(studio.figure(figure));
  }
  return figures;
}

}  // namespace vndf::tools
