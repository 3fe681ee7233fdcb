// The golden sequence, x_k = frac(k (phi - 1) + shift), a quasi-random sequence: its points leave
// no large gaps in [0, 1) at any length. No grid has a common period with it, so that tables are
// measured between their nodes and not at them.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>

namespace vndf::support {

/// Point `k`, in [0, 1), of the sequence that starts at `shift`.
inline double golden(std::size_t k, double shift = 0.5) {
  const double x = static_cast<double>(k) * (std::numbers::phi - 1) + shift;
  return x - std::floor(x);
}

}  // namespace vndf::support
