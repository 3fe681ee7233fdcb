// Turns the pair of tables into those of a kernel (kernel_text.h): cells of cubics, split until
// each keeps its tolerance, so that a sample needs neither the pair's roots nor its map.
#pragma once

#include <cstddef>
#include <stdexcept>

#include "vndf/kernel_tables.h"
#include "vndf/slope_tables.h"

namespace vndf {

/// The tolerances that bake() takes.
inline constexpr double kLeastTolerance = 1e-6, kMostTolerance = 1e-2;

struct BakeOptions {
  /// Largest difference from the pair, in u, of either slope, from kLeastTolerance to
  /// kMostTolerance.
  double tolerance = 1e-5;
  /// Most bytes of guides and patches, which are what sampling reads. Within them the faster layout
  /// is taken: columns by q, or, where those do not fit, the smaller ones by its root.
  std::size_t max_bytes = 262144;
};

/// No layout keeps the tolerance within the bytes. The message says what was reached and what would
/// be needed.
class BakeError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The kernel's tables of `pair`, with the differences from it in their header. They have no
/// certificate yet, for the exact law is not known here. Throws BakeError, and
/// std::invalid_argument for options outside their range or a pair that check() refuses.
KernelTables bake(const SlopeTables& pair, const BakeOptions& options = {});

}  // namespace vndf
