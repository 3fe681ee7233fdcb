// A rough surface as a BSDF sees it: a sampler of normals, a surface (or its roughness alone, if it
// is flat) and a masking model. Above and below are told by the mean facet. Heitz and d'Eon 2014
// sample a BSDF in two ways, which differ only here: Algorithm 2 draws visible normals, and
// Algorithm 1 draws all normals and weights them by how visible they are.
#pragma once

#include <algorithm>

#include "vndf/bsdf/masking.h"
#include "vndf/bsdf/normal_sampler.h"
#include "vndf/on_surface.h"

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
  Microsurface(const Sampler& sampler, const RoughSurface<T>& surface, Masking = {})
      : on_(sampler, surface) {}
  Microsurface(const Sampler& sampler, const Alpha<T>& alpha, Masking = {})
      : on_(sampler, RoughSurface<T>(alpha)) {}

  const Sampler& sampler() const noexcept { return on_.sampler(); }
  const RoughSurface<T>& surface() const noexcept { return on_.surface(); }

  /// Positive for a direction above the surface, negative below, 0 along it.
  T height(const Vec3<T>& w) const noexcept { return surface().projected_area(w); }

  /// Whether `w` and the mean facet see the same side of the facet `wm`.
  bool sees(const Vec3<T>& w, const Vec3<T>& wm) const noexcept {
    return sees_facet(on_.direction(w), on_.normal(wm).unit);
  }

  /// D_wi(wm) = (G1(wi, wm) / wi.z) (wi.wm)+ D(wm) (equation 2), finite up to the horizon; 0 below
  /// it. All of it is that of the flat surface.
  T visible_density(const Vec3<T>& wi, const Vec3<T>& wm) const noexcept {
    const Vec3<T> w = on_.direction(wi);
    const auto m = on_.normal(wm);
    const T cosine = dot(w, m.unit);
    if (!(w.z >= T(0) && cosine > T(0))) return T(0);
    // At the horizon G1 / w.z is 0 / 0. Its limit is reached long before this height.
    constexpr T kLowest = T(1e-15);
    const Vec3<T> above{w.x, w.y, std::max(w.z, kLowest)};
    return Masking::g1(sampler(), above, m.unit, alpha()) / above.z * cosine *
           sampler().d(m.unit, alpha()) / m.cube();
  }

  /// Density with which sample_normal() draws `wm`; 0 for a facet that faces away from wi, or for
  /// wi below the horizon.
  T pdf(const Vec3<T>& wi, const Vec3<T>& wm) const noexcept {
    return height(wi) >= T(0) && dot(wi, wm) > T(0) ? on_.pdf(wi, wm) : T(0);
  }

  /// Draws a normal for wi above the surface. Its weight is 0 where the facet faces away. Otherwise
  /// it is 1 for a sampler of visible normals, and (wi.wm) G1 / (wi.z wm.z) for one of all normals,
  /// which is the weight of Algorithm 1 without G2 / G1.
  WeightedNormal<T> sample_normal(const Vec3<T>& wi, T u1, T u2) const noexcept {
    const Vec3<T> wm = on_.sample(wi, u1, u2);
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
    if (!(height(wo) > T(0))) return T(0);
    return Masking::shadowing_of_reflection(masking(wi, wm), masking(wo, wm));
  }

  /// G2 / G1(wi) in [0, 1] for wi above the surface and wo below; 0 for wo on or above it.
  T shadowing_of_transmission(const Vec3<T>& wi, const Vec3<T>& wo,
                              const Vec3<T>& wm) const noexcept {
    if (!(height(wo) < T(0))) return T(0);
    return Masking::shadowing_of_transmission(masking(wi, wm), masking(wo, wm));
  }

 private:
  const Alpha<T>& alpha() const { return surface().alpha(); }

  /// G1(w, wm).
  T masking(const Vec3<T>& w, const Vec3<T>& wm) const {
    return Masking::g1(sampler(), on_.direction(w), on_.normal(wm).unit, alpha());
  }

  OnSurface<Sampler> on_;
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
