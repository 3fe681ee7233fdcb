// Structures of arrays, over which batches of normals are drawn.
#pragma once

#include <span>

namespace vndf {

/// Unit vectors, one component a span; all of one size.
struct DirectionSpans {
  std::span<const float> x, y, z;
};
struct AlphaSpans {
  std::span<const float> x, y;
};
struct NormalSpans {
  std::span<float> x, y, z;
};

}  // namespace vndf
