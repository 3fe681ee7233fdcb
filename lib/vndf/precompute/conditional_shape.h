// How the distribution of y given x depends on x. For Gaussian, Student-T and Pearson II slopes,
// and for no others that are smooth, y is a scale that depends on x times one and the same
// variable: all rows of the conditional table are equal. This is found by looking at the density,
// not at its name.
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

/// Largest difference between values of the conditional table that counts as none.
inline constexpr double kSameConditional = 1e-10;

ConditionalShape conditional_shape(const UnitSlopes& slopes);

}  // namespace vndf::precompute
