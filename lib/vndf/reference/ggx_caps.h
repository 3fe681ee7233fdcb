// Visible GGX normals by spherical caps (Dupuy and Benyoub 2023, "Sampling Visible GGX Normals with
// Spherical Caps"). At unit roughness the facets of GGX form a hemisphere of mirrors. It reflects a
// parallel beam from wi into directions c that are uniform over the cap c.z > -wi.z of the unit
// sphere, and the normal is the half vector c + wi.
#pragma once

#include <cmath>
#include <numbers>

#include "vndf/reference/ggx.h"
#include "vndf/reference/smith.h"

namespace vndf {

/// The Method (smith.h) of GgxCaps.
struct GgxCapsMethod {
  /// In double the Jacobian of the map times pdf() is 1 within kJacobianError wherever a finite
  /// difference can measure it. In float no more than the fraction kFloatError of all pairs (u1,
  /// u2) give slopes whose |CDF - u| is above kFloatError.
  static constexpr double kJacobianError = 1e-7, kFloatError = 2e-5;

  template <class T>
  static HomogeneousSlope<T> sample_slope(const Incidence<T>& wi, const Probability<T>& u1,
                                          const Probability<T>& u2) {
    // The height on the cap is z = h - cos, from -cos to 1. `above` is 1 + z and `below` is 1 - z,
    // written so that neither cancels.
    const T h = u2.complement * (T(1) + wi.cos);
    const T below = u2.u * (T(1) + wi.cos);
    const T above = wi.sin * wi.sin / (T(1) + wi.cos) + h;
    const T horizontal = std::sqrt(above * below);
    const T half = std::numbers::pi_v<T> * u1.u;
    if (h == T(0)) return rim(half);
    const T cos = std::cos(half), sin = std::sin(half);
    // c + wi. Its x = horizontal cos(phi) + wi.sin cancels near the rim, where it must not err by
    // more than a rounding of h. There horizontal^2 = wi.sin^2 + h (2 wi.cos - h) gives the
    // difference wi.sin - horizontal = -gap without cancellation.
    const T sum = wi.sin + horizontal;
    const T gap = sum > T(0) ? h * (T(2) * wi.cos - h) / sum : T(0);
    const T x = T(2) * horizontal * cos * cos - gap, y = T(2) * horizontal * cos * sin;
    return {-x, -y, h};
  }

  /// The slope at the rim of the cap, where c = (sin cos(phi), sin sin(phi), -cos). The sum c + wi
  /// is 2 sin cos(phi / 2) (cos(phi / 2), sin(phi / 2), 0), whose length may be 0 but not its
  /// direction.
  template <class T>
  static HomogeneousSlope<T> rim(T half_phi) {
    const T cos = std::cos(half_phi), sin = std::sin(half_phi);
    return cos < T(0) ? HomogeneousSlope<T>{cos, sin, T(0)} : HomogeneousSlope<T>{-cos, -sin, T(0)};
  }
};

/// An exact sampler. Its map is not the inverse of the CDFs of slope_x and slope_y: no slope is
/// monotone in u1 or u2.
template <class T>
using GgxCaps = VisibleSampler<T, GgxShape, GgxCapsMethod>;

}  // namespace vndf
