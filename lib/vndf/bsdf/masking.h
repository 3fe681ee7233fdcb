// Masking and shadowing of the two surface models of Heitz and d'Eon 2014 (section 2.1): Smith's,
// with heights uncorrelated or correlated (Heitz 2014), and V-cavities. A BSDF needs two functions
// of a model, both taken from the masking G1 of one direction:
//
//   g1(sampler, w, wm, alpha)        G1(w, wm), the part of the facets wm that w sees, 0 for w on
//                                    their back or on the other side of the surface;
//   shadowing_of_reflection(gi, go)  G2 / G1(wi, wm) for gi = G1(wi, wm), go = G1(wo, wm), that is
//   shadowing_of_transmission        the weight of Algorithm 2; never above 1.
//
// In terms of G1 nothing is infinite at the horizon, where Lambda is: 1 + Lambda = 1 / G1.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>

#include "vndf/bsdf/beta_function.h"
#include "vndf/vec.h"

namespace vndf {

/// True where `w` and the geometric surface see the same side of the facet `wm`, wm.z >= 0: the
/// Heaviside function chi+(w.wm / w.z).
template <class T>
bool sees_facet(const Vec3<T>& w, const Vec3<T>& wm) noexcept {
  return dot(w, wm) * std::copysign(T(1), w.z) > T(0);
}

/// Smith's model: heights and normals independent, so that G1 is the same for every facet seen.
struct SmithMasking {
  template <class S, class T>
  static T g1(const S& sampler, const Vec3<T>& w, const Vec3<T>& wm,
              const Alpha<T>& alpha) noexcept {
    return sees_facet(w, wm) ? sampler.g1(w, alpha) : T(0);
  }
};

/// G2 = G1(wi) G1(wo): masking and shadowing independent. Maximum error: 1 rounding, as given G1.
struct SmithSeparable : SmithMasking {
  template <class T>
  static T shadowing_of_reflection(T, T go) noexcept {
    return go;
  }
  template <class T>
  static T shadowing_of_transmission(T, T go) noexcept {
    return go;
  }
};

/// Both directions see the facet at one height (Heitz 2014). The probability h of a smaller height
/// is uniform in [0, 1]. A direction above the surface sees the facet with probability h^Lambda,
/// one below with (1 - h)^Lambda, so G2 is the integral over h of h^(Lambda_i + Lambda_o) in
/// reflection, 1 / (1 + Lambda_i + Lambda_o), and of h^Lambda_i (1 - h)^Lambda_o in transmission,
/// B(1 + Lambda_i, 1 + Lambda_o).
struct SmithCorrelated : SmithMasking {
  /// Multiplied by 1 + Lambda_i = 1 / gi: go / (gi + go (1 - gi)), a sum of positive terms. Where
  /// both directions are horizontal it has no limit; 0. Maximum error: 4 roundings.
  template <class T>
  static T shadowing_of_reflection(T gi, T go) noexcept {
    return go > T(0) ? std::min(T(1), go / (gi + go * (T(1) - gi))) : T(0);
  }

  /// Maximum relative error: kBetaError. A G1 below 1e-18 counts as that.
  template <class T>
  static T shadowing_of_transmission(T gi, T go) noexcept {
    constexpr T kSmallest = T(1e-18);
    if (!(go > T(0))) return T(0);
    const T a = T(1) / std::max(gi, kSmallest), b = T(1) / std::max(go, kSmallest);
    return std::min(T(1), a * beta_function(a, b));
  }
};

/// V-cavities: each facet wm = (x, y, z) faces (-x, -y, z), and only those two mask each other
/// (equation 3). G2 is min(G1, G1) in reflection, max(G1 + G1 - 1, 0) in transmission. Maximum
/// error: 2 roundings.
struct VCavityMasking {
  template <class S, class T>
  static T g1(const S&, const Vec3<T>& w, const Vec3<T>& wm, const Alpha<T>&) noexcept {
    if (!sees_facet(w, wm)) return T(0);
    return std::min(T(1), T(2) * wm.z * std::abs(w.z) / std::abs(dot(w, wm)));
  }
  template <class T>
  static T shadowing_of_reflection(T gi, T go) noexcept {
    return go >= gi ? (go > T(0) ? T(1) : T(0)) : go / gi;
  }
  template <class T>
  static T shadowing_of_transmission(T gi, T go) noexcept {
    const T both = gi - (T(1) - go);
    return both > T(0) ? both / gi : T(0);
  }
};

/// What a BSDF asks of a masking model.
template <class M, class S, class T>
concept MaskingModel = requires(const S& sampler, const Vec3<T>& w, const Alpha<T>& alpha, T g) {
  { M::g1(sampler, w, w, alpha) }
  noexcept->std::same_as<T>;
  { M::shadowing_of_reflection(g, g) }
  noexcept->std::same_as<T>;
  { M::shadowing_of_transmission(g, g) }
  noexcept->std::same_as<T>;
};

/// G2(wi, wo, wm): reflection where wi and wo are on one side of the surface, otherwise
/// transmission.
template <class M, class S, class T>
T g2(const S& sampler, const Vec3<T>& wi, const Vec3<T>& wo, const Vec3<T>& wm,
     const Alpha<T>& alpha) noexcept {
  const T gi = M::g1(sampler, wi, wm, alpha), go = M::g1(sampler, wo, wm, alpha);
  const bool one_side = (wi.z > T(0)) == (wo.z > T(0));
  return gi *
         (one_side ? M::shadowing_of_reflection(gi, go) : M::shadowing_of_transmission(gi, go));
}

}  // namespace vndf
