// Samples all normals of a distribution that is not shape-invariant (Heitz and d'Eon 2014,
// Algorithm 1). Stretching would change the shape of such a distribution, so its anisotropic form
// varies the roughness a with the azimuth instead, 1 / a^2 = cos^2(phi) / alpha_x^2 + sin^2(phi) /
// alpha_y^2, and keeps the isotropic distribution along each azimuth:
//
//   D(theta, phi) = D_a(theta) a^2 / (alpha_x alpha_y),   p(phi) = a^2 / (2 pi alpha_x alpha_y)
//
// A Profile is the isotropic distribution. Its density(cos2, sin2, a2) is D_a, and elevation(u, a2)
// the sine and cosine of the theta that a normal exceeds with probability 1 - u. Masking has no
// closed form, so that of a similar SmithSurface takes its place.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "vndf/stretch.h"
#include "vndf/table_coordinates.h"

namespace vndf {

/// Sine and cosine of the angle between a normal and the vertical.
template <class T>
struct Elevation {
  T sin, cos;
};

/// Samples all normals of `Profile`, with lambda() and g1() of `Masking`.
template <class T, class Profile, class Masking>
class AzimuthalNdf : public Masking {
 public:
  using Scalar = T;
  static constexpr bool kVisible = false;

  explicit AzimuthalNdf(const Profile& profile = Profile()) : profile_(profile) {}

  /// Draws a normal from D(wm) wm.z whatever `wi` is, with its azimuth from u1 and its elevation
  /// from u2. A u outside [0, 1] is moved to the nearer end. Returns a unit normal with wm.z >= 0,
  /// which may face away from `wi`, and (0, 0, 1) for an input outside its range.
  Vec3<T> sample(const Vec3<T>& wi, const Alpha<T>& alpha, T u1, T u2) const noexcept {
    if (!valid(wi, alpha)) return {T(0), T(0), T(1)};
    // A point uniform on the circle that is stretched to the radii alpha has an azimuth of density
    // p(phi) and the distance a.
    const T turn = T(2) * std::numbers::pi_v<T> * probability(u1).u;
    const Azimuth<T> phi = azimuth(alpha.x * std::cos(turn), alpha.y * std::sin(turn));
    const Elevation<T> theta = profile_.elevation(probability(u2), phi.length * phi.length);
    return normalize_or_up(Vec3<T>{theta.sin * phi.cos, theta.sin * phi.sin, theta.cos});
  }

  /// Density of normals D(wm) per solid angle; 0 for a horizontal or back-facing normal.
  T d(const Vec3<T>& wm, const Alpha<T>& alpha) const noexcept {
    if (!valid(wm, alpha) || !(wm.z > T(0))) return T(0);
    const Azimuth<T> phi = azimuth(wm.x, wm.y);
    const T x = phi.cos / alpha.x, y = phi.sin / alpha.y;
    const T a2 = T(1) / (x * x + y * y);
    return profile_.density(wm.z * wm.z, phi.length * phi.length, a2) * (a2 / (alpha.x * alpha.y));
  }

  /// Density of sample() per solid angle, D(wm) wm.z.
  T pdf(const Vec3<T>& wi, const Vec3<T>& wm, const Alpha<T>& alpha) const noexcept {
    return valid(wi, alpha) ? d(wm, alpha) * wm.z : T(0);
  }

 private:
  Profile profile_;
};

}  // namespace vndf
