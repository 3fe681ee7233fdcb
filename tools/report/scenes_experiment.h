// The experiment behind the pictures of Heitz and d'Eon 2014: scenes with rough surfaces, rendered
// with every way of drawing normals at equal samples and at equal time, and compared with a
// reference.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "report/scene_figure.h"
#include "vndf/kernel_tables.h"
#include "vndf/support/parallel.h"

namespace vndf::tools {

struct ScenesOptions {
  std::size_t size = 320;                  ///< width and height of a picture, at least 2 pixels
  std::uint32_t samples = 64;              ///< of each pixel, at equal samples
  std::uint32_t reference_samples = 1024;  ///< of each pixel of a reference, at least 2
  std::uint64_t seed = 1;
  /// Their progress is that of the whole experiment.
  support::Workers workers = {};
};

/// Baked tables by the names of their distributions.
using SceneTables = std::map<std::string, std::shared_ptr<const KernelTables>>;

/// Builds and bakes the tables that the figures need, which takes some seconds.
SceneTables bake_scene_tables(unsigned threads);

/// Renders Figures 1 and 9 of the paper (a plate of glass), 2 and 10 (a pedestal of metal, with and
/// without light that is sampled directly). A figure of many samples has them in fewer pixels, so
/// that each takes as long.
std::vector<SceneFigure> run_scenes_experiment(const SceneTables& tables,
                                               const ScenesOptions& options);

}  // namespace vndf::tools
