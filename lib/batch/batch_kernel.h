// What a batch kernel is given, once the sizes are judged: the same for every target.
#pragma once

#include <cstddef>

#include "batch/blocks.h"

namespace vndf::batch {

/// Incident directions and roughness, each for `per_direction` samples side by side.
struct DirectionInputs {
  std::size_t size, per_direction;
  Input x, y, z, alpha_x, alpha_y;
};

/// The random numbers and the results.
struct Samples {
  std::size_t size;
  Input u1, u2;
  Output x, y, z;
};

}  // namespace vndf::batch
