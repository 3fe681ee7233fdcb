// The previous method, Algorithm 1 of Heitz and d'Eon 2014, for any distribution: normals drawn
// from D(wm) wm.z whatever the incident direction. At normal incidence all facets are visible and
// D_z(wm) = wm.z D(wm), so a sampler of visible normals draws them too.
#pragma once

#include <utility>

#include "vndf/bsdf/normal_sampler.h"

namespace vndf {

/// A sampler of all normals from one of Smith's visible normals, with its errors.
template <class T, class Visible>
requires NormalSampler<Visible, T>
class AllNormals {
 public:
  static constexpr bool kVisible = false;

  explicit AllNormals(Visible visible) : visible_(std::move(visible)) {}

  Vec3<T> sample(const Vec3<T>&, const Alpha<T>& alpha, T u1, T u2) const noexcept {
    return visible_.sample(kUp, alpha, u1, u2);
  }
  T pdf(const Vec3<T>&, const Vec3<T>& wm, const Alpha<T>& alpha) const noexcept {
    return visible_.pdf(kUp, wm, alpha);
  }
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
