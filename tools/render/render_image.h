// Renders a scene: every pixel is the mean of paths through it (box filter).
#pragma once

#include <cstddef>
#include <cstdint>

#include "render/image.h"
#include "render/scene.h"
#include "vndf/support/parallel.h"

namespace vndf::render {

struct RenderOptions {
  /// In pixels, at least 1 each.
  std::size_t width = 512, height = 512;
  /// Paths through each pixel, at least 1.
  std::uint32_t samples = 64;
  /// If > 0, as many paths as fit into this time, in place of `samples`; at least 1.
  double seconds = 0;
  std::uint64_t seed = 1;
  /// Whether light is also sampled directly and the two ways are combined.
  bool sample_lights = true;
  /// The image does not depend on the number of threads.
  support::Workers workers = {};
};

struct Rendering {
  Image image;
  std::uint32_t samples;  ///< paths through each pixel
  double seconds;         ///< that rendering took, without the preparation of the scene
};

/// Throws std::invalid_argument for a size or a number of samples of 0, and std::runtime_error if
/// Embree fails.
Rendering render(const Scene& scene, const RenderOptions& options);

}  // namespace vndf::render
