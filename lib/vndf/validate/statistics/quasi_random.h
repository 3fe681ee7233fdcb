// Points that fill the unit square evenly: the additive sequence of the plastic number (Roberts
// 2018). No grid has a common period with it, and no point is in the middle.
#pragma once

#include <cmath>
#include <cstddef>

#include "vndf/validate/exact/configuration.h"

namespace vndf::validate {

/// Point `k`, whole single-precision numbers in [0, 1).
inline RandomPair quasi_random_point(std::size_t k) {
  const auto part = [k](double step) {
    const double x = static_cast<double>(k) * step + 0.3;
    return std::fmin(to_single(x - std::floor(x)), 1 - 0x1p-24);
  };
  return {part(0.7548776662466927), part(0.5698402909980532)};
}

}  // namespace vndf::validate
