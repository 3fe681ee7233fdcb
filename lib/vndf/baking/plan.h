// Where the cells of a kernel lie: rows and columns, split until one cubic follows the pair in
// each.
#pragma once

#include <array>
#include <cstddef>

#include "vndf/baking/surface.h"
#include "vndf/kernel_tables.h"
#include "vndf/slope_tables.h"

namespace vndf::baking {

/// Cells of the map and rows of the conditional over |s - s0| of one half of s.
struct SlopeHalf {
  Axis map = {}, rows = {};
};

/// The power of two by which places above s0 are larger: more than the octaves of one half.
inline constexpr int kSlopeOctaves = 8;

/// Where the cells of a kernel lie.
struct Plan {
  double unit;
  Columns columns;
  Axis directions = {}, lower = {}, upper = {};  // of the marginal: rows, columns around 1/2
  Axis conditional = {}, mirrored = {};          // columns of the conditional
  std::array<SlopeHalf, 2> slopes = {};          // below and above s0, unless separable
  double direction_offset = 0x1p-8, slope_offset = 0x1p-8;
  bool separable = false;

  std::size_t slope_rows() const {
    return slopes[0].rows.cells.size() + slopes[1].rows.cells.size();
  }

  /// Bytes of patches and guides.
  std::size_t bytes() const {
    const std::size_t row = 64 * directions.cells.size();
    const std::size_t cell = separable ? 16 : 64 * slope_rows();
    const std::size_t keys =
        2 * lower.count() + (separable ? 1 : 2) * conditional.count() + directions.count();
    std::size_t sum = row * (lower.cells.size() + upper.cells.size()) +
                      cell * (conditional.cells.size() + mirrored.cells.size()) +
                      sizeof(kernel::Guide) * keys;
    if (separable) return sum;
    for (const SlopeHalf& half : slopes)
      sum += 16 * half.map.cells.size() + 2 * sizeof(kernel::Guide) * half.map.count();
    return sum;
  }
};

/// The plan for `pair` with these columns, in the unit that needs the fewest rows, each of rows and
/// columns within the criterion.
Plan plan_for(const SlopeTables& pair, const Columns& columns, const Criterion& criterion);

}  // namespace vndf::baking
