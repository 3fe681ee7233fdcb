// Reflection and transmission by a rough dielectric, over any sampler of normals (Heitz and d'Eon
// 2014, section 2). With the Fresnel reflectance F of the facet wm that joins wi and wo,
//
//   f |wo.z| = R (G2 / G1) D_wi(wm) |d wm / d wo|,   R = F in reflection, 1 - F in transmission,
//
// which is the paper's f_r and f_t with the common factors gathered into D_wi. It counts energy, so
// that a surface without loss sends out all that comes in; f_t(wi, wo) / n_o^2 is the same read
// backwards, and radiance along a transmitted wi is that along wo times (n_i / n_o)^2.
#pragma once

#include <optional>

#include "vndf/bsdf/fresnel.h"
#include "vndf/bsdf/microsurface.h"
#include "vndf/bsdf/scatter.h"

namespace vndf {

/// No function throws or allocates; an input that is not a number gives 0. wi may be on either side
/// of the surface. At eta = 1 transmission is a delta function at -wi: sample() draws it with its
/// weight and the pdf 0, evaluate() and pdf() are 0.
template <class T, class Sampler, class Masking>
class DielectricBsdf {
 public:
  /// `eta` > 0 is the refractive index below the surface over that above. `sampler` must outlive
  /// this object.
  DielectricBsdf(const Sampler& sampler, const Alpha<T>& alpha, T eta)
      : surface_(sampler, alpha), eta_(eta) {}

  /// f(wi, wo) |wo.z|, wo on either side.
  T evaluate(const Vec3<T>& wi, const Vec3<T>& wo) const noexcept {
    if (wi.z < T(0)) return inside_out().evaluate(mirrored(wi), mirrored(wo));
    const Facet facet = facet_between(wi, wo);
    const T density = outgoing_density(surface_.visible_density(wi, facet.wm), facet.jacobian);
    return density > T(0) ? facet.chance * shadowing(wi, wo, facet.wm) * density : T(0);
  }

  /// Density with which sample() draws wo. Its integral is 1 less the part that is lost.
  T pdf(const Vec3<T>& wi, const Vec3<T>& wo) const noexcept {
    if (wi.z < T(0)) return inside_out().pdf(mirrored(wi), mirrored(wo));
    const Facet facet = facet_between(wi, wo);
    return facet.chance * outgoing_density(surface_.pdf(wi, facet.wm), facet.jacobian);
  }

  /// Draws a normal by u1 and u2, then reflects with probability F, where u3 < F, or transmits. The
  /// weight is f |wo.z| / pdf: G2 / G1 for visible normals (Algorithm 2), which is never above 1;
  /// G2 (wi.wm) / (wi.z wm.z) for all normals (Algorithm 1).
  BsdfSample<T, T> sample(const Vec3<T>& wi, T u1, T u2, T u3) const noexcept {
    if (wi.z < T(0)) {
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
    if (!(reflects ? wo.z > T(0) : wo.z < T(0))) return {wo, T(0), T(0)};
    const T weight = normal.weight * shadowing(wi, wo, normal.wm);
    const T chance = reflects ? reflectance : T(1) - reflectance;
    return {wo, weight, chance * outgoing_density(normal.pdf, jacobian(wi, wo, normal.wm))};
  }

 private:
  /// What joins two directions.
  struct Facet {
    Vec3<T> wm;
    T chance;    // F or 1 - F
    T jacobian;  // |d wo / d wm|
  };

  /// The dielectric seen from below, turned over: D is the same turned by 180 degrees.
  DielectricBsdf inside_out() const { return {surface_.sampler(), surface_.alpha(), T(1) / eta_}; }
  static Vec3<T> mirrored(const Vec3<T>& w) { return {w.x, w.y, -w.z}; }

  Facet facet_between(const Vec3<T>& wi, const Vec3<T>& wo) const {
    const bool reflects = wo.z > T(0);
    const Vec3<T> wm =
        reflects ? reflection_half_vector(wi, wo) : transmission_half_vector(wi, wo, eta_);
    const T cosine = dot(wi, wm);
    const bool joined = cosine > T(0) && wo.z != T(0) && sees_facet(wo, wm);
    if (!joined) return {wm, T(0), T(0)};
    const T reflectance = fresnel_dielectric(cosine, eta_);
    return {wm, reflects ? reflectance : T(1) - reflectance, jacobian(wi, wo, wm)};
  }

  T jacobian(const Vec3<T>& wi, const Vec3<T>& wo, const Vec3<T>& wm) const {
    return wo.z > T(0) ? reflection_jacobian(dot(wi, wm))
                       : refraction_jacobian(dot(wi, wm), dot(wo, wm), eta_);
  }

  T shadowing(const Vec3<T>& wi, const Vec3<T>& wo, const Vec3<T>& wm) const {
    return wo.z > T(0) ? surface_.shadowing_of_reflection(wi, wo, wm)
                       : surface_.shadowing_of_transmission(wi, wo, wm);
  }

  Microsurface<T, Sampler, Masking> surface_;
  T eta_;
};

}  // namespace vndf
