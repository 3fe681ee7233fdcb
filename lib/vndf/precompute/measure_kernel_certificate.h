// Measures baked tables against the exact distribution, as measure_certificate.h does the pair from
// which they are baked. The kernel is run step by step (kernel_text.h), in single precision.
#pragma once

#include "vndf/certificate.h"
#include "vndf/kernel.h"
#include "vndf/precompute/unit_slopes.h"
#include "vndf/support/parallel.h"

namespace vndf::precompute {

/// Returns the errors of `kernel` as those of the distribution of `slopes`. Its u1 and u2 end at
/// 2^-25 and 1 - 2^-24, so nothing beyond them is measured. The slope y is measured at slopes x
/// that the kernel itself draws.
Certificate measure_certificate(const UnitSlopes& slopes, const Kernel& kernel,
                                const support::Workers& workers);

}  // namespace vndf::precompute
