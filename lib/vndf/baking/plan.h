// The plan of a kernel: where the cells of its axes lie. Rows and columns are split until one cubic
// follows the pair in each, so that cells are fine where a table bends and nowhere else.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "vndf/baking/pair_slopes.h"
#include "vndf/baking/surface.h"
#include "vndf/kernel.h"

namespace vndf::baking {

/// The cells over |s - s0| of one half of s: those of the map, and the rows of the conditional.
struct SlopeHalf {
  Axis map = {}, rows = {};
};

/// By how many powers of two places above s0 are larger: more than the octaves that one half has.
inline constexpr int kSlopeOctaves = 8;

/// The cells of what directions below the horizon have of their own.
struct PlanBelow {
  Axis directions = {}, lower = {}, upper = {};     ///< rows and columns of the marginal
  Axis rows = {}, conditional = {}, mirrored = {};  ///< of y; empty if the pair is separable
};

struct Plan {
  const PairSlopes& pair;  ///< in the unit that was chosen
  Columns columns;
  Axis directions = {};                  ///< rows of the marginal
  Axis lower = {}, upper = {};           ///< columns of the marginal, u1 below and above one half
  Axis conditional = {}, mirrored = {};  ///< columns of the conditional
  std::array<SlopeHalf, 2> slopes = {};  ///< below and above s0; empty if the pair is separable
  // How far the first place of an axis is from 0, which decides how fine its cells can be there.
  // 2^-6 and 2^-10 change the bytes by 6 % at most; but of slopes 2^-10 has more than
  // kSlopeOctaves.
  double direction_offset = 0x1p-8, slope_offset = 0x1p-8;

  /// Has no cells where there is nothing for directions below the horizon.
  PlanBelow below = {};

  std::size_t slope_rows() const {
    return slopes[0].rows.cells.size() + slopes[1].rows.cells.size();
  }

  /// Bytes of patches and guides.
  std::size_t bytes() const {
    const bool separable = pair.separable();
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

/// The plan with these columns, in that unit of `candidates` which needs the fewest rows. Each of
/// rows and columns keeps within the criterion. The plan refers to the candidate.
Plan plan_for(const std::vector<PairSlopes>& candidates, const Columns& columns,
              const Criterion& criterion);

/// Adds what directions below the horizon need, within a criterion of its own.
void plan_below(Plan& plan, const Criterion& criterion);

}  // namespace vndf::baking
