// Bakes the pair of tables and measures what came of it, so that a file of baked tables says how
// exact it is itself and not only how near to the pair.
#pragma once

#include "vndf/baking/bake.h"
#include "vndf/precompute/unit_slopes.h"
#include "vndf/support/parallel.h"

namespace vndf::precompute {

/// The kernel's tables of `pair`, which was made from `slopes`, with `text` and the certificate
/// that is measured against them. Throws as bake() does.
KernelTables bake_certified(const UnitSlopes& slopes, const SlopeTables& pair,
                            const BakeOptions& options, const KernelText& text,
                            const support::Workers& workers);

/// The same of the distribution itself, which is integrated again.
KernelTables bake_certified(const distributions::SlopeDistribution& distribution,
                            const SlopeTables& pair, const BakeOptions& options = {});

/// The same where the law of `pair` cannot be had again: the certificate, marked as not measured,
/// is that of the pair with the differences from it added. Of the density and of the tails these
/// tell nothing.
KernelTables bake_uncertified(const SlopeTables& pair, const Certificate& certificate,
                              const BakeOptions& options, const KernelText& text);

}  // namespace vndf::precompute
