// Quasi-random points of the unit square: the additive sequence of the plastic number (Roberts
// 2018). They fill the square more evenly than random ones. No grid has a common period with them,
// so that tables are checked between their nodes, and none of them is in the middle of the square.
#pragma once

#include <cmath>
#include <cstddef>

#include "vndf/validate/exact/configuration.h"

namespace vndf::validate {

/// Point `k`, of single-precision numbers in [0, 1).
inline RandomPair quasi_random_point(std::size_t k) {
  const auto part = [k](double step) {
    const double x = static_cast<double>(k) * step + 0.3;
    return std::fmin(to_single(x - std::floor(x)), 1 - 0x1p-24);
  };
  return {part(0.7548776662466927), part(0.5698402909980532)};
}

}  // namespace vndf::validate
