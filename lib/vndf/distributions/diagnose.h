// Finds out what is wrong with a slope distribution before any work is done with it. A wrong
// formula would otherwise end in a quadrature that does not converge, or in tables of something
// else.
#pragma once

#include "vndf/distributions/slope_distribution.h"

namespace vndf::distributions {

struct DiagnoseOptions {
  /// Whether p22 may be infinite at r = 0. That of the K distribution is, and its integrals are
  /// known to exist.
  bool singularity_at_zero_allowed = false;
};

/// Throws std::domain_error, one line that names the distribution, if p22 is negative, infinite or
/// not a number, if its mass does not lie within the radii below, if it is zero between two radii
/// at which it is not, if it cannot be normalised, and if its mean slope is infinite. A hole in the
/// middle, as of a ring, is allowed. p22 is tried at 4000 radii from 1e-8 to 1e8, equidistant in
/// log r, and on both sides of every break, so that an empty interval of less than 1 % may be
/// missed.
void diagnose(const SlopeDistribution& d, const DiagnoseOptions& options = {});

}  // namespace vndf::distributions
