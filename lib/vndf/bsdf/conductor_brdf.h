// Reflection by a rough metal, with any sampler of normals (Heitz and d'Eon 2014, section 2):
//
//   f(wi, wo) = F(wi, wm) G2(wi, wo, wm) D(wm) / (4 wi.z wo.z),   wm the half vector of wi and wo.
//
// We evaluate it through visible normals, f wo.z = F (G2 / G1) D_wi(wm) |d wm / d wo|, because each
// factor of this is finite up to the horizon. Directions point away from the surface.
#pragma once

#include <utility>

#include "vndf/bsdf/fresnel.h"
#include "vndf/bsdf/microsurface.h"
#include "vndf/bsdf/scatter.h"

namespace vndf {

/// The BRDF of a rough metal. The constructor deduces the types:
///
///     const vndf::ConductorBrdf metal(ggx, {0.3f, 0.1f}, gold);
///     const vndf::ConductorBrdf grooves(cavities, {0.3f, 0.1f}, gold, vndf::VCavityMasking{});
///
/// `Fresnel` maps wi.wm to an array of reflectances in [0, 1], one for each channel of colour
/// (ConductorFresnel). No function throws or allocates. A component that is not a number, wi below
/// the horizon and wo not above it give 0.
template <class Sampler, class Fresnel, class Masking = SmithCorrelated>
class ConductorBrdf {
  using T = typename Sampler::Scalar;

 public:
  using Value = decltype(std::declval<const Fresnel&>()(T(1)));

  /// Refers to `sampler`, which must outlive this object. Valid: what the sampler says of alpha.
  ConductorBrdf(const Sampler& sampler, const Alpha<T>& alpha, const Fresnel& fresnel, Masking = {})
      : ConductorBrdf(sampler, RoughSurface<T>(alpha), fresnel) {}
  /// The same with correlated slopes or a mean slope. wi.z and wo.z in f are then the areas that
  /// the mean facet shows to them (RoughSurface::projected_area()), and tell what is above the
  /// surface.
  ConductorBrdf(const Sampler& sampler, const RoughSurface<T>& surface, const Fresnel& fresnel,
                Masking = {})
      : surface_(sampler, surface), fresnel_(fresnel) {}
  ConductorBrdf(const Sampler&&, const Alpha<T>&, const Fresnel&, Masking = {}) = delete;
  ConductorBrdf(const Sampler&&, const RoughSurface<T>&, const Fresnel&, Masking = {}) = delete;

  /// f(wi, wo) wo.z for each channel.
  Value evaluate(const Vec3<T>& wi, const Vec3<T>& wo) const noexcept {
    if (!above(wi, wo)) return Value{};
    const Vec3<T> wm = reflection_half_vector(wi, wo);
    const T cosine = dot(wi, wm);
    const T density =
        outgoing_density(surface_.visible_density(wi, wm), reflection_jacobian(cosine));
    if (!(density > T(0))) return Value{};
    return scaled(fresnel_(cosine), surface_.shadowing_of_reflection(wi, wo, wm) * density);
  }

  /// Density with which sample() draws wo, per solid angle. Its integral is 1 minus the
  /// probability that the light is lost.
  T pdf(const Vec3<T>& wi, const Vec3<T>& wo) const noexcept {
    if (!above(wi, wo)) return T(0);
    const Vec3<T> wm = reflection_half_vector(wi, wo);
    if (!surface_.sees(wo, wm)) return T(0);
    return outgoing_density(surface_.pdf(wi, wm), reflection_jacobian(dot(wi, wm)));
  }

  /// Draws wo. Its weight f wo.z / pdf is F G2 / G1 for visible normals (Algorithm 2), never above
  /// 1, and F G2 (wi.wm) / (wi.z wm.z) for all normals (Algorithm 1), which has no bound.
  BsdfSample<T, Value> sample(const Vec3<T>& wi, T u1, T u2) const noexcept {
    const WeightedNormal<T> normal = surface_.sample_normal(wi, u1, u2);
    const Vec3<T> wo = reflect(wi, normal.wm);
    if (!(normal.weight > T(0) && surface_.height(wo) > T(0))) return {wo, Value{}, T(0)};
    const T cosine = dot(wi, normal.wm);
    const T weight = normal.weight * surface_.shadowing_of_reflection(wi, wo, normal.wm);
    return {wo, scaled(fresnel_(cosine), weight),
            outgoing_density(normal.pdf, reflection_jacobian(cosine))};
  }

 private:
  bool above(const Vec3<T>& wi, const Vec3<T>& wo) const {
    return surface_.height(wi) >= T(0) && surface_.height(wo) > T(0);
  }

  static Value scaled(Value value, T factor) {
    for (T& channel : value) channel *= factor;
    return value;
  }

  Microsurface<Sampler, Masking> surface_;
  Fresnel fresnel_;
};

}  // namespace vndf
