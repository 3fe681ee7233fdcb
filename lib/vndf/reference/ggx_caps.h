// Visible GGX normals by spherical caps (Dupuy and Benyoub 2023, "Sampling Visible GGX Normals with
// Spherical Caps"). At unit roughness GGX is a hemisphere of mirrors, and a parallel beam along wi
// leaves them as directions uniform over the cap c.z > -wi.z of the unit sphere: the normal is
// c + wi.
#pragma once

#include <cmath>
#include <numbers>

#include "vndf/reference/ggx.h"
#include "vndf/reference/smith.h"

namespace vndf {

struct GgxCapsMethod {
  /// In double the Jacobian of the map times pdf() is 1 within kJacobianError, where a finite
  /// difference of it can be taken. In float no more than kFloatError of all pairs (u1, u2) give
  /// slopes whose exact CDFs are off by more than kFloatError.
  static constexpr double kJacobianError = 1e-7, kFloatError = 2e-5;

  template <class T>
  static HomogeneousSlope<T> sample_slope(const Incidence<T>& wi, const Probability<T>& u1,
                                          const Probability<T>& u2) {
    // The cap: height z = h - cos, from -cos to 1, of which 1 - z and 1 + z do not cancel.
    const T h = u2.complement * (T(1) + wi.cos);
    const T below = u2.u * (T(1) + wi.cos);
    const T above = wi.sin * wi.sin / (T(1) + wi.cos) + h;
    const T horizontal = std::sqrt(above * below);
    const T half = std::numbers::pi_v<T> * u1.u;
    if (h == T(0)) return rim(half);
    const T cos = std::cos(half), sin = std::sin(half);
    // c + wi. Its x = horizontal cos(phi) + wi.sin cancels near the rim, where it must be small
    // beside h: horizontal^2 = wi.sin^2 + h (2 wi.cos - h) gives wi.sin - horizontal = -gap.
    const T sum = wi.sin + horizontal;
    const T gap = sum > T(0) ? h * (T(2) * wi.cos - h) / sum : T(0);
    const T x = T(2) * horizontal * cos * cos - gap, y = T(2) * horizontal * cos * sin;
    return {-x, -y, h};
  }

  /// The rim of the cap, where c = (sin cos(phi), sin sin(phi), -cos) and c + wi, which may vanish,
  /// is 2 sin cos(phi / 2) (cos(phi / 2), sin(phi / 2), 0).
  template <class T>
  static HomogeneousSlope<T> rim(T half_phi) {
    const T cos = std::cos(half_phi), sin = std::sin(half_phi);
    return cos < T(0) ? HomogeneousSlope<T>{cos, sin, T(0)} : HomogeneousSlope<T>{-cos, -sin, T(0)};
  }
};

/// An exact sampler. The map is not the inverse of CDFs in x and y: slopes are monotone neither in
/// u1 nor in u2.
template <class T>
using GgxCaps = VisibleSampler<T, GgxShape, GgxCapsMethod>;

}  // namespace vndf
