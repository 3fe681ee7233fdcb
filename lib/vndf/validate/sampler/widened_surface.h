// Walter's trick under test. His samplers draw all normals at the widened roughness
// alpha' = (1.2 - 0.2 sqrt(cos(theta_i))) alpha (Walter et al. 2007, section 5.3). We pass the
// smaller alpha that the paper's formula widens to the roughness of the configuration, so that the
// sampler must draw all normals of that roughness. A wrong factor in its code then fails.
#pragma once

#include <cmath>
#include <utility>

#include "vndf/vec.h"

namespace vndf::validate {

template <class T, class Widening>
class WidenedSurface {
 public:
  static_assert(!Widening::kVisible, "Walter's trick is for samplers of all normals");
  using Scalar = T;
  static constexpr bool kVisible = false;

  explicit WidenedSurface(Widening sampler = Widening()) : sampler_(std::move(sampler)) {}

  Vec3<T> sample(const Vec3<T>& wi, const Alpha<T>& alpha, T u1, T u2) const noexcept {
    return sampler_.sample(wi, narrowed(wi, alpha), u1, u2);
  }
  T pdf(const Vec3<T>& wi, const Vec3<T>& wm, const Alpha<T>& alpha) const noexcept {
    return sampler_.pdf(wi, wm, narrowed(wi, alpha));
  }

  /// The surface itself is not widened.
  T d(const Vec3<T>& wm, const Alpha<T>& alpha) const noexcept { return sampler_.d(wm, alpha); }
  T lambda(const Vec3<T>& w, const Alpha<T>& alpha) const noexcept {
    return sampler_.lambda(w, alpha);
  }
  T g1(const Vec3<T>& w, const Alpha<T>& alpha) const noexcept { return sampler_.g1(w, alpha); }

 private:
  /// The paper's formula is written anew here: were it asked of the sampler, a wrong factor would
  /// cancel.
  static Alpha<T> narrowed(const Vec3<T>& wi, const Alpha<T>& alpha) {
    const T factor = T(1.2) - T(0.2) * std::sqrt(std::abs(wi.z));
    return {alpha.x / factor, alpha.y / factor};
  }

  Widening sampler_;
};

}  // namespace vndf::validate
