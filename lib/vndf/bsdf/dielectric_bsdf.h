// Reflection and transmission by a rough dielectric, with any sampler of normals (Heitz and d'Eon
// 2014, section 2). With the Fresnel reflectance F of the facet wm that joins wi and wo,
//
//   f |wo.z| = R (G2 / G1) D_wi(wm) |d wm / d wo|,   R = F in reflection, 1 - F in transmission.
//
// These are the paper's f_r and f_t with their common factors gathered into D_wi, which is finite
// up to the horizon. f transports energy: a surface without loss sends out all that comes in. Hence
// f_t(wi, wo) / n_o^2 is symmetric in the two directions, and a renderer that transports radiance
// along a transmitted wi multiplies that along wo by (n_i / n_o)^2.
#pragma once

#include <optional>

#include "vndf/bsdf/fresnel.h"
#include "vndf/bsdf/microsurface.h"
#include "vndf/bsdf/scatter.h"

namespace vndf {

/// The BSDF of a rough dielectric. The constructor deduces the types, for example
/// `vndf::DielectricBsdf glass(ggx, {0.3f, 0.1f}, 1.5f)`.
///
/// wi and wo may be on either side of the surface. No function throws or allocates. A component
/// that is not a number gives 0. At eta = 1 transmission is a delta function at -wi: sample() draws
/// it with its weight and a pdf of 0, while evaluate() and pdf() give 0 there.
template <class Sampler, class Masking = SmithCorrelated>
class DielectricBsdf {
  using T = typename Sampler::Scalar;

 public:
  /// `eta` > 0 is the refractive index below the surface over that above. Refers to `sampler`,
  /// which must outlive this object. Valid: what the sampler says of alpha.
  DielectricBsdf(const Sampler& sampler, const Alpha<T>& alpha, T eta, Masking = {})
      : DielectricBsdf(sampler, RoughSurface<T>(alpha), eta) {}
  /// The same with correlated slopes or a mean slope, as in ConductorBrdf.
  DielectricBsdf(const Sampler& sampler, const RoughSurface<T>& surface, T eta, Masking = {})
      : surface_(sampler, surface), eta_(eta) {}
  DielectricBsdf(const Sampler&&, const Alpha<T>&, T, Masking = {}) = delete;
  DielectricBsdf(const Sampler&&, const RoughSurface<T>&, T, Masking = {}) = delete;

  /// f(wi, wo) |wo.z|.
  T evaluate(const Vec3<T>& wi, const Vec3<T>& wo) const noexcept {
    if (surface_.height(wi) < T(0)) return inside_out().evaluate(mirrored(wi), mirrored(wo));
    const Facet facet = facet_between(wi, wo);
    const T density = outgoing_density(surface_.visible_density(wi, facet.wm), facet.jacobian);
    return density > T(0) ? facet.chance * shadowing(wi, wo, facet.wm) * density : T(0);
  }

  /// Density with which sample() draws wo, per solid angle. Its integral is 1 minus the
  /// probability that the light is lost.
  T pdf(const Vec3<T>& wi, const Vec3<T>& wo) const noexcept {
    if (surface_.height(wi) < T(0)) return inside_out().pdf(mirrored(wi), mirrored(wo));
    const Facet facet = facet_between(wi, wo);
    return facet.chance * outgoing_density(surface_.pdf(wi, facet.wm), facet.jacobian);
  }

  /// Draws a normal with u1 and u2, then reflects where u3 < F and transmits elsewhere. The weight
  /// f |wo.z| / pdf is G2 / G1 for visible normals (Algorithm 2), never above 1, and
  /// G2 (wi.wm) / (wi.z wm.z) for all normals (Algorithm 1), which has no bound.
  BsdfSample<T, T> sample(const Vec3<T>& wi, T u1, T u2, T u3) const noexcept {
    if (surface_.height(wi) < T(0)) {
      auto drawn = inside_out().sample(mirrored(wi), u1, u2, u3);
      drawn.wo = mirrored(drawn.wo);
      return drawn;
    }
    const WeightedNormal<T> normal = surface_.sample_normal(wi, u1, u2);
    if (!(normal.weight > T(0))) return {wi, T(0), T(0)};
    const T cosine = dot(wi, normal.wm);
    const T reflectance = fresnel_dielectric(cosine, eta_);
    const std::optional<Vec3<T>> refracted = refract(wi, normal.wm, eta_);
    const bool reflects = u3 < reflectance || !refracted;
    const Vec3<T> wo = reflects ? reflect(wi, normal.wm) : *refracted;
    if (!(reflects ? surface_.height(wo) > T(0) : surface_.height(wo) < T(0)))
      return {wo, T(0), T(0)};
    const T weight = normal.weight * shadowing(wi, wo, normal.wm);
    const T chance = reflects ? reflectance : T(1) - reflectance;
    return {wo, weight, chance * outgoing_density(normal.pdf, jacobian(wi, wo, normal.wm))};
  }

 private:
  /// The facet that sends wi to wo.
  struct Facet {
    Vec3<T> wm;
    T chance;    // F or 1 - F
    T jacobian;  // |d wo / d wm|
  };

  /// The same surface seen from below. Its facets are turned by 180 degrees, and D is the same.
  DielectricBsdf inside_out() const {
    return {surface_.sampler(), surface_.surface().from_below(), T(1) / eta_};
  }
  static Vec3<T> mirrored(const Vec3<T>& w) { return {w.x, w.y, -w.z}; }

  Facet facet_between(const Vec3<T>& wi, const Vec3<T>& wo) const {
    const bool reflects = surface_.height(wo) > T(0);
    const Vec3<T> wm =
        reflects ? reflection_half_vector(wi, wo) : transmission_half_vector(wi, wo, eta_);
    const T cosine = dot(wi, wm);
    const bool joined = cosine > T(0) && surface_.height(wo) != T(0) && surface_.sees(wo, wm);
    if (!joined) return {wm, T(0), T(0)};
    const T reflectance = fresnel_dielectric(cosine, eta_);
    return {wm, reflects ? reflectance : T(1) - reflectance, jacobian(wi, wo, wm)};
  }

  T jacobian(const Vec3<T>& wi, const Vec3<T>& wo, const Vec3<T>& wm) const {
    return surface_.height(wo) > T(0) ? reflection_jacobian(dot(wi, wm))
                                      : refraction_jacobian(dot(wi, wm), dot(wo, wm), eta_);
  }

  T shadowing(const Vec3<T>& wi, const Vec3<T>& wo, const Vec3<T>& wm) const {
    return surface_.height(wo) > T(0) ? surface_.shadowing_of_reflection(wi, wo, wm)
                                      : surface_.shadowing_of_transmission(wi, wo, wm);
  }

  Microsurface<Sampler, Masking> surface_;
  T eta_;
};

}  // namespace vndf
