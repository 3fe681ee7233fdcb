// The experiment behind the pictures of Heitz and d'Eon 2014: scenes with rough surfaces, rendered
// with every way of drawing normals at equal samples and at equal time, and compared with a
// reference.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "report/scene_figure.h"
#include "vndf/support/parallel.h"

namespace vndf::tools {

struct ScenesOptions {
  std::size_t size = 256;                  ///< width and height of a picture, at least 2 pixels
  std::uint32_t samples = 64;              ///< of each pixel, at equal samples
  std::uint32_t reference_samples = 1024;  ///< of each pixel of a reference, at least 2
  std::uint64_t seed = 1;
  /// Their progress is that of the whole experiment.
  support::Workers workers = {};
};

/// Renders all figures: 1 and 9 of the paper (a plate of glass), 10 and 2 (a pedestal of metal,
/// without and with light that is sampled directly). The tables of GGX and Beckmann are built and
/// baked before. A figure of many samples has them in fewer pixels, so that each takes as long.
std::vector<SceneFigure> run_scenes_experiment(const ScenesOptions& options);

}  // namespace vndf::tools
