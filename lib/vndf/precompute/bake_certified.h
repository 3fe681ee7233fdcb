// Bakes a pair of tables and measures the baked tables against the exact distribution. Without this
// a file of baked tables would only tell how near it is to its pair.
#pragma once

#include "vndf/baking/bake.h"
#include "vndf/precompute/unit_slopes.h"
#include "vndf/support/parallel.h"

namespace vndf::precompute {

/// Bakes `pair`, which was made from `slopes`, and adds `text` and the measured certificate. Throws
/// as bake() does.
KernelTables bake_certified(const UnitSlopes& slopes, const SlopeTables& pair,
                            const BakeOptions& options, const KernelText& text,
                            const support::Workers& workers);

/// Bakes `pair`, which was made from `distribution`. The integrals of the distribution are computed
/// again. Throws as bake() and UnitSlopes do.
KernelTables bake_certified(const distributions::SlopeDistribution& distribution,
                            const SlopeTables& pair, const BakeOptions& options = {});

/// Bakes a pair whose distribution is not known any more. The certificate is that of the pair, with
/// the differences between the pair and the baked tables added to the errors in u, and is marked as
/// not measured. The differences say nothing about densities and tails, so these get the largest
/// error there is. Throws as bake() does.
KernelTables bake_uncertified(const SlopeTables& pair, const Certificate& certificate,
                              const BakeOptions& options, const KernelText& text);

}  // namespace vndf::precompute
