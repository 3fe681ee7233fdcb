// A rough surface as a BSDF sees it: a sampler of normals, a roughness and a masking model. The two
// ways of sampling a BSDF differ only here: Algorithm 2 of Heitz and d'Eon 2014 draws visible
// normals, Algorithm 1 all normals with a weight that makes up for it.
#pragma once

#include <algorithm>

#include "vndf/bsdf/masking.h"
#include "vndf/bsdf/normal_sampler.h"

namespace vndf {

/// Unit normals and what they are worth.
template <class T>
struct WeightedNormal {
  Vec3<T> wm;
  T weight;  ///< D_wi(wm) / pdf: 1 for a sampler of visible normals
  T pdf;     ///< of the sampler, per solid angle of wm; 0 where the normal is not to be used
};

/// `Masking` must be the model whose visible normals `Sampler` draws, if it draws visible ones:
/// Smith's for TabulatedSampler and the analytic samplers of slopes, VCavityMasking for
/// Algorithm 3.
template <class T, class Sampler, class Masking>
requires NormalSampler<Sampler, T> && MaskingModel<Masking, Sampler, T>
class Microsurface {
 public:
  /// `sampler` must outlive this object. Valid: what the sampler says of alpha.
  Microsurface(const Sampler& sampler, const Alpha<T>& alpha) : sampler_(&sampler), alpha_(alpha) {}

  const Sampler& sampler() const noexcept { return *sampler_; }
  const Alpha<T>& alpha() const noexcept { return alpha_; }

  /// D_wi(wm) = (G1(wi, wm) / wi.z) (wi.wm)+ D(wm) (equation 2), for wi.z >= 0; finite up to the
  /// horizon.
  T visible_density(const Vec3<T>& wi, const Vec3<T>& wm) const noexcept {
    const T cosine = dot(wi, wm);
    if (!(wi.z >= T(0) && cosine > T(0))) return T(0);
    // G1 / wi.z has a limit at the horizon, which is reached long before this height.
    constexpr T kLowest = T(1e-15);
    const Vec3<T> above{wi.x, wi.y, std::max(wi.z, kLowest)};
    return Masking::g1(*sampler_, above, wm, alpha_) / above.z * cosine * sampler_->d(wm, alpha_);
  }

  /// Density of the normals that sample_normal() draws and that wi sees, for wi.z >= 0.
  T pdf(const Vec3<T>& wi, const Vec3<T>& wm) const noexcept {
    return wi.z >= T(0) && dot(wi, wm) > T(0) ? sampler_->pdf(wi, wm, alpha_) : T(0);
  }

  /// Draws a normal for wi.z >= 0. The weight is 0 for a normal that faces away, never above 1 for
  /// visible normals, and (wi.wm) G1 / (wi.z wm.z) for all normals (Algorithm 1 but for G2 / G1).
  WeightedNormal<T> sample_normal(const Vec3<T>& wi, T u1, T u2) const noexcept {
    const Vec3<T> wm = sampler_->sample(wi, alpha_, u1, u2);
    const T density = pdf(wi, wm);
    if (!(density > T(0))) return {wm, T(0), T(0)};
    if constexpr (Sampler::kVisible) return {wm, T(1), density};
    // By the two densities rather than by 1 / wm.z, for a sampler that widens D on purpose.
    return {wm, visible_density(wi, wm) / density, density};
  }

  /// G2 / G1(wi) of wi and wo above the surface, in [0, 1].
  T shadowing_of_reflection(const Vec3<T>& wi, const Vec3<T>& wo,
                            const Vec3<T>& wm) const noexcept {
    if (!(wo.z > T(0))) return T(0);
    return Masking::shadowing_of_reflection(Masking::g1(*sampler_, wi, wm, alpha_),
                                            Masking::g1(*sampler_, wo, wm, alpha_));
  }

  /// The same of wi above and wo below.
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

/// What a BSDF draws. Where the light is lost, for the facet is not seen or wo leaves on the wrong
/// side, weight and pdf are 0 and wo means nothing.
template <class T, class Value>
struct BsdfSample {
  Vec3<T> wo;
  Value weight;  ///< f(wi, wo) |wo.z| / pdf
  T pdf;         ///< per solid angle of wo
};

}  // namespace vndf
