// Masking and shadowing of the two surface models of Heitz and d'Eon 2014 (section 2.1): Smith's,
// with heights uncorrelated or correlated (Heitz 2014), and V-cavities. A model is a type with
// three functions, and a BSDF takes it as a template argument:
//
//   g1(sampler, w, wm, alpha)        G1(w, wm), the fraction of the facets wm that w sees; 0 for w
//                                    behind them or on the other side of the surface;
//   shadowing_of_reflection(gi, go)  G2 / G1(wi, wm) for gi = G1(wi, wm) and go = G1(wo, wm), which
//   shadowing_of_transmission        is the weight of Algorithm 2 and never above 1.
//
// The last two take G1 rather than Lambda, because Lambda is infinite at the horizon and G1 is 0
// there: 1 + Lambda = 1 / G1.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>

#include "vndf/bsdf/beta_function.h"
#include "vndf/vec.h"

namespace vndf {

/// Largest error of G2 / G1 for given G1, in roundings of T: relative in Smith's models, absolute
/// in that of V-cavities. Correlated transmission has that of beta_function() instead.
inline constexpr double kShadowingRoundings = 4;

/// True where `w` and the geometric surface see the same side of the facet `wm`, wm.z >= 0: the
/// Heaviside function chi+(w.wm / w.z).
template <class T>
bool sees_facet(const Vec3<T>& w, const Vec3<T>& wm) noexcept {
  return dot(w, wm) * std::copysign(T(1), w.z) > T(0);
}

/// Smith's model, in which heights and normals are independent, so that G1 is the same for every
/// facet that w faces.
struct SmithMasking {
  template <class S, class T>
  static T g1(const S& sampler, const Vec3<T>& w, const Vec3<T>& wm,
              const Alpha<T>& alpha) noexcept {
    return sees_facet(w, wm) ? sampler.g1(w, alpha) : T(0);
  }
};

/// Smith's model with masking and shadowing independent: G2 = G1(wi) G1(wo).
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

/// Smith's model with one height for both directions (Heitz 2014), the usual choice of a renderer.
///
/// The probability h of a smaller height is uniform in [0, 1]. A direction above the surface sees
/// the facet with probability h^Lambda and one below with (1 - h)^Lambda. In reflection G2 is
/// therefore the integral over h of h^(Lambda_i + Lambda_o), which is 1 / (1 + Lambda_i +
/// Lambda_o). In transmission it is that of h^Lambda_i (1 - h)^Lambda_o, which is B(1 + Lambda_i, 1
/// + Lambda_o).
struct SmithCorrelated : SmithMasking {
  /// go / (gi + go (1 - gi)), the quotient G2 / G1 in terms of G1, in which nothing cancels. It is
  /// 0 where both directions are horizontal, because no limit exists there. Maximum error:
  /// kShadowingRoundings.
  template <class T>
  static T shadowing_of_reflection(T gi, T go) noexcept {
    return go > T(0) ? std::min(T(1), go / (gi + go * (T(1) - gi))) : T(0);
  }

  /// B(1 / gi, 1 / go) / gi. A G1 below 1e-18 counts as 1e-18. Maximum error: that
  /// of beta_function().
  template <class T>
  static T shadowing_of_transmission(T gi, T go) noexcept {
    constexpr T kSmallest = T(1e-18);
    if (!(go > T(0))) return T(0);
    const T a = T(1) / std::max(gi, kSmallest), b = T(1) / std::max(go, kSmallest);
    return std::min(T(1), a * beta_function(a, b));
  }
};

/// V-cavities: each facet wm = (x, y, z) forms a groove with (-x, -y, z), and only these two mask
/// each other (equation 3). With gi = G1(wi) and go = G1(wo), G2 is min(gi, go) in reflection and
/// max(gi + go - 1, 0) in transmission. Maximum error:
/// kShadowingRoundings.
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

/// Satisfied by the masking models that a BSDF accepts for the sampler `S` in precision `T`.
template <class M, class S, class T>
concept MaskingModel = requires(const S& sampler, const Vec3<T>& w, const Alpha<T>& alpha, T g) {
  { M::g1(sampler, w, w, alpha) }
  noexcept->std::same_as<T>;
  { M::shadowing_of_reflection(g, g) }
  noexcept->std::same_as<T>;
  { M::shadowing_of_transmission(g, g) }
  noexcept->std::same_as<T>;
};

/// G2(wi, wo, wm) of the model `M`, for reflection where wi and wo are on the same side of the
/// surface and for transmission elsewhere.
template <class M, class S, class T>
T g2(const S& sampler, const Vec3<T>& wi, const Vec3<T>& wo, const Vec3<T>& wm,
     const Alpha<T>& alpha) noexcept {
  const T gi = M::g1(sampler, wi, wm, alpha), go = M::g1(sampler, wo, wm, alpha);
  const bool one_side = (wi.z > T(0)) == (wo.z > T(0));
  return gi *
         (one_side ? M::shadowing_of_reflection(gi, go) : M::shadowing_of_transmission(gi, go));
}

}  // namespace vndf
