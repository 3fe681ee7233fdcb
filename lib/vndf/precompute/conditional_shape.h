// Finds out whether the distribution of y given x is the same at every x, up to a scale of y. It is
// for Gaussian, Student-T and Pearson II slopes, and for no other distribution that is smooth. All
// rows of the conditional table are then equal, so that one row is computed and interpolation
// between rows adds no error. The density decides and not its name, so that a formula typed by a
// user gains as well.
#pragma once

#include "vndf/precompute/unit_slopes.h"
#include "vndf/table_coordinates.h"

namespace vndf::precompute {

struct ConditionalShape {
  /// sqrt(1 + B x^2) with the B that makes all conditionals the same, or else plain_scale().
  ConditionalScale<double> scale;
  /// Whether the conditional of y / scale is the same at every x, to kSameConditional.
  bool factorises = false;
};

/// Differences between values of the conditional table up to this one count as none. It lies
/// between the errors of quantiles, 1e-12, and those of single precision, 6e-8.
inline constexpr double kSameConditional = 1e-10;

/// Compares the conditionals at x = 0 and at three other slopes.
ConditionalShape conditional_shape(const UnitSlopes& slopes);

}  // namespace vndf::precompute
