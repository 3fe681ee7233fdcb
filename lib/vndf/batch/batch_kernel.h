// What a batch works on, once the sizes of its spans are checked. It is the same for every target.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "vndf/batch/blocks.h"
#include "vndf/kernel.h"

namespace vndf::batch {

/// Incident directions and roughness, each for one sample.
struct DirectionInputs {
  Input x, y, z, alpha_x, alpha_y;
};

/// The random numbers and the results, which are normals of `surface`.
struct Samples {
  std::size_t size;
  Input u1, u2;
  Output x, y, z;
  RoughSurface<float> surface = Alpha<float>{1, 1};
};

/// The directions of a block: kernel::VndfDirection as arrays. Those below the horizon, which have
/// patches of their own, are drawn from one by one; the arrays have the first row of patches for
/// them.
struct Directions {
  Lanes<float> alpha_x, alpha_y;
  Lanes<float> x, y, z;
  Lanes<float> h2, hu;
  Lanes<float> g;
  Lanes<std::uint32_t> row;

  std::uint64_t below = 0;  ///< bit i: whether sample i is below the horizon
  std::array<kernel::VndfDirection, kBlock> lower;  ///< set for those samples

  void set(std::size_t i, const kernel::VndfDirection& d) {
    const bool is_below = d.kind == kernel::kVndfBelow;
    alpha_x.at[i] = d.alpha_x;
    alpha_y.at[i] = d.alpha_y;
    x.at[i] = d.x;
    y.at[i] = d.y;
    z.at[i] = d.z;
    h2.at[i] = d.h2;
    hu.at[i] = d.hu;
    g.at[i] = is_below ? 0 : d.g;
    row.at[i] = is_below ? 0 : d.row;
    if (!is_below || i >= kBlock) return;
    below |= std::uint64_t{1} << i;
    lower[i] = d;
  }
};

/// Pointers to the inputs of a block.
struct DirectionBlock {
  const float *x, *y, *z, *alpha_x, *alpha_y;
};

/// Step 1 of samples begin to end - 1 of a block by the scalar kernel, which covers directions next
/// to the pole and inputs outside their range. Few samples need it, and it is compiled once, for
/// any processor.
void stretch_each(const kernel::VndfTables& tables, const DirectionBlock& inputs, std::size_t begin,
                  std::size_t end, Directions& directions);

/// Steps 2 to 5 of those samples of a block, of `n`, that are below the horizon, by the scalar
/// kernel.
void sample_each_below(const kernel::VndfTables& tables, const Directions& directions,
                       const RoughSurface<float>& surface, std::size_t n, const float* u1,
                       const float* u2, float* x, float* y, float* z);

}  // namespace vndf::batch
