// Replaces a costly density by a curve: log p22 over asinh(r / scale), with nodes that crowd at the
// centre, in segments between its breaks. A build evaluates p22 some 1e7 times, so that every
// 100 ns of it cost a second; Bessel functions take several of these.
#pragma once

#include <memory>

#include "vndf/distributions/slope_distribution.h"
#include "vndf/support/parallel.h"

namespace vndf::precompute {

/// Returns `d` with an interpolated p22, whose relative error is 1e-11 where p22 is smooth. `scale`
/// is a typical slope. `d` must outlive the result.
std::unique_ptr<distributions::SlopeDistribution> interpolated_density(
    const distributions::SlopeDistribution& d, double scale, const support::Workers& workers);

}  // namespace vndf::precompute
