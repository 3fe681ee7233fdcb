// Walter's trick, for comparison: all normals are drawn at a roughness widened at grazing
// incidence, alpha' = (1.2 - 0.2 sqrt(|cos(theta_i)|)) alpha, which lowers the largest weights
// (Walter et al. 2007, section 5.3; Heitz and d'Eon 2014, section 2.2).
#pragma once

#include <cmath>

#include "vndf/vec.h"

namespace vndf {

/// Widens `NdfSampler`, any sampler of all normals. sample() and pdf() use the widened roughness,
/// while d(), lambda() and g1() use the true one. The pdf is therefore not D(wm) wm.z.
template <class NdfSampler>
class WalterRoughness {
  using T = typename NdfSampler::Scalar;

 public:
  using Scalar = T;
  static_assert(!NdfSampler::kVisible, "Walter's trick is for samplers of all normals");
  static constexpr bool kVisible = false;

  explicit WalterRoughness(const NdfSampler& sampler = NdfSampler()) : sampler_(sampler) {}

  /// The roughness alpha' for `wi`.
  static Alpha<T> widened(const Vec3<T>& wi, const Alpha<T>& alpha) noexcept {
    const T factor = T(1.2) - T(0.2) * std::sqrt(std::abs(wi.z));
    return {factor * alpha.x, factor * alpha.y};
  }

  Vec3<T> sample(const Vec3<T>& wi, const Alpha<T>& alpha, T u1, T u2) const noexcept {
    return sampler_.sample(wi, widened(wi, alpha), u1, u2);
  }
  T pdf(const Vec3<T>& wi, const Vec3<T>& wm, const Alpha<T>& alpha) const noexcept {
    return sampler_.pdf(wi, wm, widened(wi, alpha));
  }

  T d(const Vec3<T>& wm, const Alpha<T>& alpha) const noexcept { return sampler_.d(wm, alpha); }
  T lambda(const Vec3<T>& w, const Alpha<T>& alpha) const noexcept {
    return sampler_.lambda(w, alpha);
  }
  T g1(const Vec3<T>& w, const Alpha<T>& alpha) const noexcept { return sampler_.g1(w, alpha); }

 private:
  NdfSampler sampler_;
};

}  // namespace vndf
