// Named families and mixtures as people type them:
//
//     ggx
//     student-t:gamma=2.5
//     mixture:0.7*ggx+0.3*beckmann@0.2    WEIGHT*FAMILY[:NAME=NUMBER,...][@ROUGHNESS] + ...
//
// Spaces around the parts are allowed. family_list.h has the names, parameters and defaults.
#pragma once

#include <memory>
#include <string>

#include "vndf/distributions/slope_distribution.h"

namespace vndf::distributions {

/// Returns the family or mixture that `spec` describes. Its name() is the same text with every
/// parameter written out, and parses to an equal distribution; specification.h builds on that.
/// Throws std::invalid_argument, one line with the column (from 1) of the error in `spec`, for an
/// unknown family or parameter (naming the nearest known one), for text that is not a number, for
/// an empty part and for a number out of its range.
std::unique_ptr<SlopeDistribution> parse_distribution(const std::string& spec);

}  // namespace vndf::distributions
