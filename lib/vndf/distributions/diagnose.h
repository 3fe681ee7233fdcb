// What is wrong with a slope distribution, found before any work is done with it.
#pragma once

#include "vndf/distributions/slope_distribution.h"

namespace vndf::distributions {

struct DiagnoseOptions {
  /// Whether p22 may be infinite at r = 0, as the K distribution is, whose integrals are known to
  /// exist.
  bool singularity_at_zero_allowed = false;
};

/// Throws std::domain_error, one line naming the distribution, where p22 is negative or not a
/// number or infinite, where it is zero between two radii at which it is not (the radii below the
/// first may be empty: a ring), where it cannot be normalised, and where its mean slope is
/// infinite. Looks at 4000 radii from 1e-8 to 1e8, evenly in log r, and on both sides of every
/// break: an empty interval of less than 1 % may pass.
void diagnose(const SlopeDistribution& d, const DiagnoseOptions& options = {});

}  // namespace vndf::distributions
