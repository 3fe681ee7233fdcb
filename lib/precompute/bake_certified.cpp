// Bakes the pair of tables and measures what came of it.
#include "precompute/bake_certified.h"

#include "precompute/measure_certificate.h"

namespace vndf::precompute {

KernelTables bake_certified(const UnitSlopes& slopes, const SlopeTables& pair,
                            const BakeOptions& options, const KernelText& text,
                            const Workers& workers) {
  const KernelTables baked = bake(pair, options);
  return baked.with(measure_certificate(slopes, baked.kernel(), workers), text);
}

}  // namespace vndf::precompute
