// Samples all normals of the GGX distribution, visible or not, by tan^2(theta) = u2 / (1 - u2) at
// unit roughness (Walter et al. 2007, equation 35).
#pragma once

#include "vndf/reference/ggx.h"
#include "vndf/reference/shape_ndf.h"

namespace vndf {

/// Largest |CDF - u| of azimuth and elevation in double and in float, all of it rounding.
inline constexpr double kGgxNdfError = 1e-15, kGgxNdfFloatError = 5e-7;

/// Draws from D(wm) wm.z. Maximum error: kGgxNdfError, in float kGgxNdfFloatError.
template <class T>
using GgxNdf = ShapeNdf<T, GgxShape>;

}  // namespace vndf
