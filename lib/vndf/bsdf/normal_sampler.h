// What a sampler of microfacet normals must offer, whether it reads tables or evaluates closed
// forms. BSDFs and the validator take any sampler as a template argument and call it directly, so
// that this freedom costs a renderer nothing.
//
//   Scalar   float or double          d        D(wm), the distribution of normals
//   sample   a normal drawn for wi    lambda   Smith's Lambda(w)
//   pdf      its density per          g1       the masking of the sampler's own surface model
//            solid angle
//
// Where kVisible is true, the sampler draws from D_wi (Heitz and d'Eon 2014, equation 2), so its
// pdf is g1(wi) dot(wi, wm)+ d(wm) / wi.z. Otherwise it draws from D(wm) wm.z and ignores wi
// (Algorithm 1). Two wrappers deviate in one function each: with V-cavities the masking depends on
// wm (reference/v_cavity.h), and Walter's trick draws from D at another roughness
// (reference/walter_roughness.h). In all cases pdf() is the density of sample().
#pragma once

#include <concepts>

#include "vndf/vec.h"

namespace vndf {

/// Satisfied by samplers of microfacet normals in the precision `T`, which is their own by default.
/// Every function is const and noexcept.
template <class S, class T = typename S::Scalar>
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
