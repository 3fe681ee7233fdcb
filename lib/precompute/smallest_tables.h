// The smallest tables that keep a tolerance: searches over sizes and ways of interpolation, each
// candidate measured off its grid as a certificate is.
#pragma once

#include <cstddef>

#include "precompute/build_tables.h"

namespace vndf::precompute {

struct SmallestOptions {
  /// Largest u-error of either table. > 0. A conditional of one row keeps its tails as well: a tail
  /// mass at 1e-6 that is off by a factor counts as fault() of build_tables.h says.
  double tolerance = 1e-5;
  /// Most bytes that sampling in single precision may touch (sampling_bytes()): 64 KiB is what a
  /// first-level cache and its neighbours hold.
  std::size_t max_bytes = 65536;
  /// 0: one thread for each processor.
  unsigned threads = 0;
};

/// Tables of `distribution` within the tolerance, with their certificate. Throws std::runtime_error
/// with the nearest that was found where no layout of max_bytes meets the tolerance, and what
/// build_tables() throws.
BuiltTables smallest_tables(const SlopeDistribution& distribution, const SmallestOptions& options);

}  // namespace vndf::precompute
