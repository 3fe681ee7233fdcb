// A rough surface as a BSDF sees it: a sampler of normals, a roughness and a masking model. Heitz
// and d'Eon 2014 sample a BSDF in two ways, which differ only here: Algorithm 2 draws visible
// normals, and Algorithm 1 draws all normals and weights them by how visible they are.
#pragma once

#include <algorithm>

#include "vndf/bsdf/masking.h"
#include "vndf/bsdf/normal_sampler.h"

namespace vndf {

/// A unit normal that a BSDF draws, with its weight.
template <class T>
struct WeightedNormal {
  Vec3<T> wm;
  T weight;  ///< D_wi(wm) / pdf, which is 1 for a sampler of visible normals
  T pdf;     ///< of the sampler, per solid angle of wm; 0 where the normal must not be used
};

/// The surface whose normals `Sampler` draws. If it draws visible ones, `Masking` must be the model
/// that they are visible in: one of Smith's for Kernel, TabulatedSampler and the samplers of slopes
/// in closed form, VCavityMasking for VCavity (Algorithm 3).
template <NormalSampler Sampler, class Masking = SmithCorrelated>
requires MaskingModel<Masking, Sampler, typename Sampler::Scalar>
class Microsurface {
  using T = typename Sampler::Scalar;

 public:
  /// Refers to `sampler`, which must outlive this object. Valid: what the sampler says of alpha.
  Microsurface(const Sampler& sampler, const Alpha<T>& alpha, Masking = {})
      : sampler_(&sampler), alpha_(alpha) {}

  const Sampler& sampler() const noexcept { return *sampler_; }
  const Alpha<T>& alpha() const noexcept { return alpha_; }

  /// D_wi(wm) = (G1(wi, wm) / wi.z) (wi.wm)+ D(wm) (equation 2), finite up to the horizon; 0 below
  /// it.
  T visible_density(const Vec3<T>& wi, const Vec3<T>& wm) const noexcept {
    const T cosine = dot(wi, wm);
    if (!(wi.z >= T(0) && cosine > T(0))) return T(0);
    // At the horizon G1 / wi.z is 0 / 0. Its limit is reached long before this height.
    constexpr T kLowest = T(1e-15);
    const Vec3<T> above{wi.x, wi.y, std::max(wi.z, kLowest)};
    return Masking::g1(*sampler_, above, wm, alpha_) / above.z * cosine * sampler_->d(wm, alpha_);
  }

  /// Density with which sample_normal() draws `wm`; 0 for a facet that faces away from wi, or for
  /// wi below the horizon.
  T pdf(const Vec3<T>& wi, const Vec3<T>& wm) const noexcept {
    return wi.z >= T(0) && dot(wi, wm) > T(0) ? sampler_->pdf(wi, wm, alpha_) : T(0);
  }

  /// Draws a normal for wi.z >= 0. Its weight is 0 where the facet faces away. Otherwise it is 1
  /// for a sampler of visible normals, and (wi.wm) G1 / (wi.z wm.z) for one of all normals, which
  /// is the weight of Algorithm 1 without G2 / G1.
  WeightedNormal<T> sample_normal(const Vec3<T>& wi, T u1, T u2) const noexcept {
    const Vec3<T> wm = sampler_->sample(wi, alpha_, u1, u2);
    const T density = pdf(wi, wm);
    if (!(density > T(0))) return {wm, T(0), T(0)};
    if constexpr (Sampler::kVisible) return {wm, T(1), density};
    // The quotient of the densities also holds for a sampler that widens D on purpose, where
    // 1 / wm.z does not.
    return {wm, visible_density(wi, wm) / density, density};
  }

  /// G2 / G1(wi) in [0, 1] for wi and wo above the surface; 0 for wo on or below it.
  T shadowing_of_reflection(const Vec3<T>& wi, const Vec3<T>& wo,
                            const Vec3<T>& wm) const noexcept {
    if (!(wo.z > T(0))) return T(0);
    return Masking::shadowing_of_reflection(Masking::g1(*sampler_, wi, wm, alpha_),
                                            Masking::g1(*sampler_, wo, wm, alpha_));
  }

  /// G2 / G1(wi) in [0, 1] for wi above the surface and wo below; 0 for wo on or above it.
  T shadowing_of_transmission(const Vec3<T>& wi, const Vec3<T>& wo,
                              const Vec3<T>& wm) const noexcept {
    if (!(wo.z < T(0))) return T(0);
    return Masking::shadowing_of_transmission(Masking::g1(*sampler_, wi, wm, alpha_),
                                              Masking::g1(*sampler_, wo, wm, alpha_));
  }

 private:
  const Sampler* sampler_;
  Alpha<T> alpha_;
};

/// A direction that a BSDF draws. Light is lost where the facet faces away or wo leaves on the
/// wrong side; then weight and pdf are 0 and wo means nothing.
template <class T, class Value>
struct BsdfSample {
  Vec3<T> wo;
  Value weight;  ///< f(wi, wo) |wo.z| / pdf
  T pdf;         ///< per solid angle of wo
};

}  // namespace vndf
