// What every sampler of microfacet normals offers, tabulated or analytic, so that a BSDF or a judge
// takes any of them as a template argument and calls it directly.
//
//   sample   a normal drawn for wi     d        D(wm), the distribution of normals
//   pdf      its density per           lambda   Smith's Lambda(w)
//            solid angle               g1       the masking of the sampler's own surface model
//
// A sampler with kVisible draws from D_wi (Heitz and d'Eon 2014, equation 2), so that its pdf is
// g1(wi) dot(wi, wm)+ d(wm) / wi.z; one without draws from D(wm) wm.z and does not look at wi
// (Algorithm 1). Two wrappers change a part of that: of V-cavities the masking depends on wm
// (reference/v_cavity.h), and Walter's trick draws from D at another roughness
// (reference/walter_roughness.h). Either way pdf() is the density of sample().
#pragma once

#include <concepts>

#include "vndf/vec.h"

namespace vndf {

template <class S, class T>
concept NormalSampler = requires(const S& s, const Vec3<T>& w, const Alpha<T>& alpha, T u) {
  { S::kVisible } -> std::convertible_to<bool>;
  { s.sample(w, alpha, u, u) }
  noexcept->std::same_as<Vec3<T>>;
  { s.pdf(w, w, alpha) }
  noexcept->std::same_as<T>;
  { s.d(w, alpha) }
  noexcept->std::same_as<T>;
  { s.lambda(w, alpha) }
  noexcept->std::same_as<T>;
  { s.g1(w, alpha) }
  noexcept->std::same_as<T>;
};

}  // namespace vndf
