// Samples all normals of the Beckmann distribution, visible or not, by tan^2(theta) = -log(1 - u2)
// at unit roughness (Walter et al. 2007, equation 28).
#pragma once

#include "vndf/reference/beckmann.h"
#include "vndf/reference/shape_ndf.h"

namespace vndf {

/// Largest |CDF - u| of azimuth and elevation in double and in float, all of it rounding.
inline constexpr double kBeckmannNdfError = 1e-15, kBeckmannNdfFloatError = 5e-7;

/// Draws from D(wm) wm.z. Maximum error: kBeckmannNdfError, in float kBeckmannNdfFloatError.
template <class T>
using BeckmannNdf = ShapeNdf<T, BeckmannShape>;

}  // namespace vndf
