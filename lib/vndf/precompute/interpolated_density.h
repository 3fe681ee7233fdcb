// A costly density in the form of a curve: log p22 over asinh(r / scale), graded at the centre, in
// segments between its breaks.
#pragma once

#include <memory>

#include "vndf/distributions/slope_distribution.h"
#include "vndf/support/parallel.h"

namespace vndf::precompute {

/// `d` with an interpolated p22, relative error 1e-11 where p22 is smooth. `scale` is a typical
/// slope. `d` must outlive the result.
std::unique_ptr<distributions::SlopeDistribution> interpolated_density(
    const distributions::SlopeDistribution& d, double scale, const support::Workers& workers);

}  // namespace vndf::precompute
