// Measures a pair of tables against the exact distribution and writes the errors into a
// certificate, so that a user of a file knows how exact it is.
//
// The tables are run as a renderer runs them: in single precision, or in double where the tables
// are. They are exact at their own nodes, so they are measured elsewhere: rows and probabilities
// follow the golden sequence, which has no common period with any grid. The hard places are added:
// between all of the first and last rows, the middles and ends of the first and last columns, both
// tails down to 1e-9, normal incidence and the horizon.
#pragma once

#include <memory>

#include "vndf/certificate.h"
#include "vndf/precompute/unit_slopes.h"
#include "vndf/slope_tables.h"
#include "vndf/support/parallel.h"

namespace vndf::precompute {

/// Returns the errors of `tables` as those of the distribution of `slopes`, from which they need
/// not have been made. A place where the sampler gives no number counts as an infinite error.
Certificate measure_certificate(const UnitSlopes& slopes,
                                const std::shared_ptr<const SlopeTables>& tables,
                                const support::Workers& workers);

}  // namespace vndf::precompute
