// The method before visible normals (Heitz and d'Eon 2014, Algorithm 1) for any distribution, so
// that the two can be compared. It draws normals from D(wm) wm.z whatever the incident direction.
// At normal incidence every facet is visible and D_z(wm) = wm.z D(wm), so a sampler of visible
// normals draws them if it is asked for that direction.
#pragma once

#include <utility>

#include "vndf/bsdf/normal_sampler.h"

namespace vndf {

/// Samples all normals with `Visible`, a sampler of Smith's visible normals. Valid inputs and
/// errors are those of `Visible`.
template <NormalSampler Visible>
class AllNormals {
  using T = typename Visible::Scalar;

 public:
  using Scalar = T;
  static constexpr bool kVisible = false;

  explicit AllNormals(Visible visible) : visible_(std::move(visible)) {}

  /// Draws a normal from D(wm) wm.z. It may face away from the incident direction, which is
  /// ignored.
  Vec3<T> sample(const Vec3<T>&, const Alpha<T>& alpha, T u1, T u2) const noexcept {
    return visible_.sample(kUp, alpha, u1, u2);
  }
  /// Density of sample() per solid angle, D(wm) wm.z.
  T pdf(const Vec3<T>&, const Vec3<T>& wm, const Alpha<T>& alpha) const noexcept {
    return visible_.pdf(kUp, wm, alpha);
  }
  /// The same functions as those of `Visible`.
  T d(const Vec3<T>& wm, const Alpha<T>& alpha) const noexcept { return visible_.d(wm, alpha); }
  T lambda(const Vec3<T>& w, const Alpha<T>& alpha) const noexcept {
    return visible_.lambda(w, alpha);
  }
  T g1(const Vec3<T>& w, const Alpha<T>& alpha) const noexcept { return visible_.g1(w, alpha); }

 private:
  static constexpr Vec3<T> kUp{T(0), T(0), T(1)};
  Visible visible_;
};

}  // namespace vndf
