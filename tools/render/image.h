// An image of radiance, which is what the path tracer makes and what surroundings are read from.
#pragma once

#include <cstddef>
#include <vector>

#include "render/vectors.h"

namespace vndf::render {

struct Image {
  std::size_t width = 0, height = 0;
  /// Row by row from the top.
  std::vector<Rgb> pixels = {};

  const Rgb& at(std::size_t x, std::size_t y) const { return pixels[y * width + x]; }
};

}  // namespace vndf::render
