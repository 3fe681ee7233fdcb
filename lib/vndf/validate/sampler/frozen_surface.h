// The surface that a sampler has at one roughness, stretched. The own alpha of Blinn-Phong and of
// generalised Trowbridge-Reitz does more than stretch the slopes, but the exact distributions are
// those of one shape (Heitz and d'Eon 2014, section 2). Frozen at one roughness and stretched from
// there, these samplers of all normals can be checked too.
#pragma once

#include <cmath>
#include <utility>

#include "vndf/vec.h"

namespace vndf::validate {

template <class T, class NdfSampler>
class FrozenSurface {
 public:
  static_assert(!NdfSampler::kVisible,
                "surfaces of visible normals are shape-invariant as they are");
  using Scalar = T;
  static constexpr bool kVisible = false;

  /// The surface that `sampler` has at the roughness `frozen` in both directions.
  FrozenSurface(NdfSampler sampler, T frozen)
      : sampler_(std::move(sampler)), frozen_{frozen, frozen} {}

  Vec3<T> sample(const Vec3<T>& wi, const Alpha<T>& alpha, T u1, T u2) const noexcept {
    const Vec3<T> m = sampler_.sample(wi, frozen_, u1, u2);
    return normalize_or_up(Vec3<T>{alpha.x * m.x, alpha.y * m.y, m.z});
  }

  /// D of the normal before the stretch, times the Jacobian of the stretch.
  T d(const Vec3<T>& wm, const Alpha<T>& alpha) const noexcept {
    const Vec3<T> m{wm.x / alpha.x, wm.y / alpha.y, wm.z};
    const T square = dot(m, m);
    return sampler_.d(normalize_or_up(m), frozen_) / (alpha.x * alpha.y * square * square);
  }
  T pdf(const Vec3<T>&, const Vec3<T>& wm, const Alpha<T>& alpha) const noexcept {
    return d(wm, alpha) * wm.z;
  }

  T lambda(const Vec3<T>& w, const Alpha<T>& alpha) const noexcept {
    return sampler_.lambda(stretched(w, alpha), frozen_);
  }
  T g1(const Vec3<T>& w, const Alpha<T>& alpha) const noexcept {
    return sampler_.g1(stretched(w, alpha), frozen_);
  }

 private:
  static Vec3<T> stretched(const Vec3<T>& w, const Alpha<T>& alpha) {
    return normalize_or_up(Vec3<T>{alpha.x * w.x, alpha.y * w.y, std::abs(w.z)});
  }

  NdfSampler sampler_;
  Alpha<T> frozen_;
};

}  // namespace vndf::validate
