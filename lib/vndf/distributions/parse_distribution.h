// Named families and mixtures as people type them:
//
//     ggx
//     student-t:gamma=2.5
//     mixture:0.7*ggx+0.3*beckmann@0.2    WEIGHT*FAMILY[:NAME=NUMBER,...][@ROUGHNESS] + ...
//
// Spaces around the parts are allowed. family_list.h has the names, parameters and defaults.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "vndf/distributions/slope_distribution.h"

namespace vndf::distributions {

/// Longest text in characters and most components of a mixture. Two lobes are usual, and the time
/// of a build grows with the components.
inline constexpr std::size_t kMaxDistributionLength = 2000, kMaxComponents = 16;

/// The roughnesses of components. Over a range of 1:1000 tables of 1024 x 1024 err by 2e-5 in u for
/// two lobes of GGX, by 1e-3 for a narrow lobe of Beckmann's, and by more where densities jump; the
/// certificate tells.
inline constexpr double kLeastRoughness = 1e-3, kGreatestRoughness = 1e3;

/// Returns the family or mixture that `spec` describes. Its name() is the same text with every
/// parameter written out, and parses to an equal distribution; specification.h builds on that.
/// Throws std::invalid_argument, one line with the column (from 1) of the error in `spec`, for an
/// unknown family or parameter (naming the nearest known one), for text that is not a number, for
/// an empty part, for a number out of its range, and for a text or mixture beyond the limits above.
std::unique_ptr<SlopeDistribution> parse_distribution(const std::string& spec);

}  // namespace vndf::distributions
