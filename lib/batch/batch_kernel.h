// What a batch kernel is given, once the sizes are judged: the same for every target.
#pragma once

#include <cstddef>

#include "batch/blocks.h"
#include "batch/sample_batch.h"

namespace vndf::batch {

/// The inputs for many incident directions.
struct DirectionInputs {
  Input x, y, z, alpha_x, alpha_y;
};

/// The random numbers and the results.
struct Samples {
  std::size_t size;
  Input u1, u2;
  Output x, y, z;
};

}  // namespace vndf::batch
