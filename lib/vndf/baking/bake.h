// Bakes a pair of tables: turns it into the block of a kernel (kernel_text.h). Sampling from the
// pair takes fourth roots and two large tables; the kernel has cubics instead, in cells that are
// split until each keeps the tolerance, and needs tens of kilobytes.
#pragma once

#include <cstddef>
#include <stdexcept>

#include "vndf/kernel_tables.h"
#include "vndf/slope_tables.h"

namespace vndf {

/// The least and the largest tolerance that bake() takes.
inline constexpr double kLeastTolerance = 1e-6, kMostTolerance = 1e-2;

struct BakeOptions {
  /// Largest difference from the pair, in u, of either slope, from kLeastTolerance to
  /// kMostTolerance.
  double tolerance = 1e-5;
  /// Most bytes of guides and patches for directions above the horizon. The faster layout, columns
  /// by q = min(u, 1 - u), is taken if it fits; else the smaller one, columns by the root of q.
  std::size_t max_bytes = 262144;
  /// Whether directions below the horizon can be sampled, which takes from 0.1 to 1.4 times as many
  /// bytes more. Sampling from above does not read them.
  bool below_horizon = true;
};

/// Thrown where no layout keeps the tolerance within the bytes. The message says what was reached,
/// what would be needed and which option to change.
class BakeError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Returns the kernel's tables of `pair`. Their header has the largest differences from the pair,
/// in u, which were measured and are at most the tolerance. They have no certificate, because the
/// exact distribution is not known here; precompute::bake_certified() measures one. Throws
/// BakeError, and std::invalid_argument for options outside their range or a pair that breaks a
/// rule of check().
KernelTables bake(const SlopeTables& pair, const BakeOptions& options = {});

}  // namespace vndf
