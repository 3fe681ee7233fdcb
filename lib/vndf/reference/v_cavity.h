// Samples visible normals of the V-cavity model, in which each facet wm = (x, y, z) forms a groove
// with its mirror image wm' = (-x, -y, z) and nothing else masks it (Heitz and d'Eon 2014, section
// 4 and appendix B).
#pragma once

#include <algorithm>
#include <cmath>

#include "vndf/bsdf/masking.h"
#include "vndf/stretch.h"
#include "vndf/table_coordinates.h"

namespace vndf {

/// Samples the visible normals of V-cavities with `NdfSampler`, any sampler of all normals.
template <class NdfSampler>
class VCavity {
  using T = typename NdfSampler::Scalar;

 public:
  using Scalar = T;
  static_assert(!NdfSampler::kVisible, "the V-cavity model is built on a sampler of all normals");
  static constexpr bool kVisible = true;

  /// sample() without u3 takes it from the binary digits of u1 that follow this many, which is half
  /// of the digits that a float or a generator of 24 bits has. The largest |CDF - u| of this is
  /// kReuseError.
  static constexpr int kKeptDigits = 12;
  static constexpr double kReuseError = 1.0 / (1 << kKeptDigits);

  explicit VCavity(const NdfSampler& sampler = NdfSampler()) : sampler_(sampler) {}

  /// Draws a normal visible from `wi` by Algorithm 3, which is exact: u1 and u2 choose the groove
  /// and u3 its side. A u outside [0, 1] is moved to the nearer end. Returns a unit normal with
  /// wm.z >= 0 and dot(wi, wm) >= 0, and (0, 0, 1) for an input outside its range.
  Vec3<T> sample(const Vec3<T>& wi, const Alpha<T>& alpha, T u1, T u2, T u3) const noexcept {
    // 1. choose the groove
    const Vec3<T> m = sampler_.sample(wi, alpha, u1, u2), mirror{-m.x, -m.y, m.z};
    if (!valid(wi, alpha)) return m;
    // 2. choose the side by projected area
    const T area = std::max(T(0), dot(wi, m)), mirror_area = std::max(T(0), dot(wi, mirror));
    const bool other = area == T(0) || probability(u3).u * (area + mirror_area) < mirror_area;
    return other ? mirror : m;
  }

  /// The same with the digits of u1 after the first kKeptDigits as u3. All of u1 still chooses the
  /// azimuth, so stratified numbers keep their strata, and up to 2^kKeptDigits strata choose both
  /// sides in the right proportion. Numbers on a lattice have equal last digits and must use the
  /// function above. Maximum error: kReuseError.
  Vec3<T> sample(const Vec3<T>& wi, const Alpha<T>& alpha, T u1, T u2) const noexcept {
    const T scaled = std::ldexp(probability(u1).u, kKeptDigits);
    return sample(wi, alpha, u1, u2, scaled - std::floor(scaled));
  }

  /// Density of sample() per solid angle, g1(wi, wm) dot(wi, wm)+ D(wm) / wi.z, in the form of
  /// appendix B because that is finite up to the horizon; 0 for an input outside its range.
  T pdf(const Vec3<T>& wi, const Vec3<T>& wm, const Alpha<T>& alpha) const noexcept {
    const T area = dot(wi, wm);
    if (!valid(wi, alpha) || !(area > T(0))) return T(0);
    const T mirror_area = std::max(T(0), dot(wi, Vec3<T>{-wm.x, -wm.y, wm.z}));
    return T(2) * (area / (area + mirror_area)) * sampler_.d(wm, alpha) * wm.z;
  }

  T d(const Vec3<T>& wm, const Alpha<T>& alpha) const noexcept { return sampler_.d(wm, alpha); }
  T lambda(const Vec3<T>& w, const Alpha<T>& alpha) const noexcept {
    return sampler_.lambda(w, alpha);
  }

  /// Masking of the facet `wm` (VCavityMasking), which unlike Smith's depends on the facet.
  T g1(const Vec3<T>& w, const Vec3<T>& wm, const Alpha<T>& alpha) const noexcept {
    return VCavityMasking::g1(sampler_, w, wm, alpha);
  }
  /// Mean of that over the facets that face `w`, weighted by their projected areas. It is Smith's
  /// G1, because both models conserve the projected area w.z.
  T g1(const Vec3<T>& w, const Alpha<T>& alpha) const noexcept { return sampler_.g1(w, alpha); }

 private:
  NdfSampler sampler_;
};

}  // namespace vndf
