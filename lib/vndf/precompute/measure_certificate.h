// Measures tables against the exact distribution, as a renderer runs them: in single precision, or
// in double where the tables are, at points off the grid. Rows and probabilities follow the golden
// ratio, which no grid is commensurate with, and the hard places are added: between all of the
// first and last rows, the middles and ends of the first and last columns, both tails to 1e-9, the
// pole and the horizon.
#pragma once

#include <memory>

#include "vndf/certificate.h"
#include "vndf/kernel.h"
#include "vndf/precompute/unit_slopes.h"
#include "vndf/slope_tables.h"
#include "vndf/support/parallel.h"

namespace vndf::precompute {

/// The certificate of `tables`, which were made from `slopes` or claim to be of the same law.
Certificate measure_certificate(const UnitSlopes& slopes,
                                const std::shared_ptr<const SlopeTables>& tables,
                                const support::Workers& workers);

/// The same of baked tables, whose u ends at 2^-25 and 1 - 2^-24. The slopes x at which slope y is
/// judged are such as samples land on.
Certificate measure_certificate(const UnitSlopes& slopes, const Kernel& kernel,
                                const support::Workers& workers);

}  // namespace vndf::precompute
