// Visible GGX normals by the projected hemisphere (Heitz 2018, "Sampling the GGX Distribution of
// Visible Normals"; proof by Engstad). At unit roughness GGX is a hemisphere, seen from wi as a
// half disk and a half ellipse: a point uniform on the disk is squeezed into them and lifted back.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "vndf/reference/ggx.h"
#include "vndf/reference/smith.h"

namespace vndf {

struct GgxHemisphereMethod {
  /// In double the Jacobian of the map times pdf() is 1 within kJacobianError, where a finite
  /// difference of it can be taken. In float no more than kFloatError of all pairs (u1, u2) give
  /// slopes whose exact CDFs are off by more than kFloatError.
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

/// An exact sampler. The map is not the inverse of CDFs in x and y: slopes are monotone neither in
/// u1 nor in u2.
template <class T>
using GgxHemisphere = VisibleSampler<T, GgxShape, GgxHemisphereMethod>;

}  // namespace vndf
