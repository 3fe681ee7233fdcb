// Visible GGX normals by the projected hemisphere (Heitz 2018, "Sampling the GGX Distribution of
// Visible Normals"). At unit roughness the facets of GGX form a hemisphere, which projects along wi
// to half a disk and half an ellipse. A point uniform on the disk is squeezed into this shape and
// lifted back to the hemisphere.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "vndf/reference/ggx.h"
#include "vndf/reference/smith.h"

namespace vndf {

/// The Method (smith.h) of GgxHemisphere.
struct GgxHemisphereMethod {
  /// In double the Jacobian of the map times pdf() is 1 within kJacobianError wherever a finite
  /// difference can measure it. In float no more than the fraction kFloatError of all pairs (u1,
  /// u2) give slopes whose |CDF - u| is above kFloatError.
  static constexpr double kJacobianError = 1e-7, kFloatError = 2e-5;

  template <class T>
  static HomogeneousSlope<T> sample_slope(const Incidence<T>& wi, const Probability<T>& u1,
                                          const Probability<T>& u2) {
    // 1. frame: wi = (sin, 0, cos), its perpendiculars (0, 1, 0) and (-cos, 0, sin)
    // 2. a point of the disk
    const T r = std::sqrt(u1.u), phi = T(2) * std::numbers::pi_v<T> * u2.u;
    const T s = r * std::cos(phi), t = r * std::sin(phi);
    // 3. squeeze t from [-h, h] into [-cos h, h], h = sqrt(1 - s^2)
    const T square = std::max(T(0), T(1) - s * s);
    const T zeta = (T(1) + wi.cos) / T(2);
    const T p = (T(1) - zeta) * std::sqrt(square) + zeta * t;
    // 4. lift to the hemisphere about wi
    const T q = std::sqrt(std::max(T(0), square - p * p));
    const T x = wi.sin * q - wi.cos * p, z = wi.cos * q + wi.sin * p;
    return {-x, -s, std::max(T(0), z)};
  }
};

/// An exact sampler. Its map is not the inverse of the CDFs of slope_x and slope_y: no slope is
/// monotone in u1 or u2.
template <class T>
using GgxHemisphere = VisibleSampler<T, GgxShape, GgxHemisphereMethod>;

}  // namespace vndf
