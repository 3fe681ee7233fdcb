// Reflection by a rough metal, over any sampler of normals (Heitz and d'Eon 2014, section 2):
//
//   f(wi, wo) = F(wi, wm) G2(wi, wo, wm) D(wm) / (4 wi.z wo.z),   wm the half vector of wi and wo.
//
// In terms of visible normals, f wo.z = F (G2 / G1) D_wi(wm) |d wm / d wo|, which is finite up to
// the horizon. Directions point away from the surface, wi is above it.
#pragma once

#include <utility>

#include "vndf/bsdf/fresnel.h"
#include "vndf/bsdf/microsurface.h"
#include "vndf/bsdf/scatter.h"

namespace vndf {

/// `Fresnel` takes wi.wm to an array of reflectances in [0, 1], one for each channel of colour. No
/// function throws or allocates; an input that is not a number or below its horizon gives 0.
template <class T, class Sampler, class Masking, class Fresnel>
class ConductorBrdf {
 public:
  using Value = decltype(std::declval<const Fresnel&>()(T(1)));

  /// `sampler` must outlive this object.
  ConductorBrdf(const Sampler& sampler, const Alpha<T>& alpha, const Fresnel& fresnel)
      : surface_(sampler, alpha), fresnel_(fresnel) {}

  /// f(wi, wo) wo.z, for each channel.
  Value evaluate(const Vec3<T>& wi, const Vec3<T>& wo) const noexcept {
    if (!above(wi, wo)) return Value{};
    const Vec3<T> wm = reflection_half_vector(wi, wo);
    const T cosine = dot(wi, wm);
    const T density =
        outgoing_density(surface_.visible_density(wi, wm), reflection_jacobian(cosine));
    if (!(density > T(0))) return Value{};
    return scaled(fresnel_(cosine), surface_.shadowing_of_reflection(wi, wo, wm) * density);
  }

  /// Density with which sample() draws wo. Its integral is 1 less the part that is lost.
  T pdf(const Vec3<T>& wi, const Vec3<T>& wo) const noexcept {
    if (!above(wi, wo)) return T(0);
    const Vec3<T> wm = reflection_half_vector(wi, wo);
    if (!sees_facet(wo, wm)) return T(0);
    return outgoing_density(surface_.pdf(wi, wm), reflection_jacobian(dot(wi, wm)));
  }

  /// Draws wo with weight f wo.z / pdf: F G2 / G1 for visible normals (Algorithm 2), which is never
  /// above 1; F G2 (wi.wm) / (wi.z wm.z) for all normals (Algorithm 1).
  BsdfSample<T, Value> sample(const Vec3<T>& wi, T u1, T u2) const noexcept {
    const WeightedNormal<T> normal = surface_.sample_normal(wi, u1, u2);
    const Vec3<T> wo = reflect(wi, normal.wm);
    if (!(normal.weight > T(0) && wo.z > T(0))) return {wo, Value{}, T(0)};
    const T cosine = dot(wi, normal.wm);
    const T weight = normal.weight * surface_.shadowing_of_reflection(wi, wo, normal.wm);
    return {wo, scaled(fresnel_(cosine), weight),
            outgoing_density(normal.pdf, reflection_jacobian(cosine))};
  }

 private:
  static bool above(const Vec3<T>& wi, const Vec3<T>& wo) { return wi.z >= T(0) && wo.z > T(0); }

  static Value scaled(Value value, T factor) {
    for (T& channel : value) channel *= factor;
    return value;
  }

  Microsurface<T, Sampler, Masking> surface_;
  Fresnel fresnel_;
};

}  // namespace vndf
