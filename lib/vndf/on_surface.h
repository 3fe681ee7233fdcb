// Any sampler of flat surfaces on a surface with correlated slopes or a mean slope, by the shear of
// rough_surface.h.
#pragma once

#include <cmath>
#include <optional>

#include "vndf/rough_surface.h"
#include "vndf/vec.h"

namespace vndf {

/// A sampler of flat surfaces, for a surface. Its functions are those of the sampler, bit for bit
/// where the surface is flat, with the same fallbacks and errors; it has those that the sampler
/// has. It refers to `sampler`, which must outlive it.
template <class Sampler>
class OnSurface {
  using T = typename Sampler::Scalar;

 public:
  using Scalar = T;

  OnSurface(const Sampler& sampler, const RoughSurface<T>& surface)
      : sampler_(&sampler), surface_(surface) {}
  OnSurface(const Sampler&&, const RoughSurface<T>&) = delete;

  const Sampler& sampler() const noexcept { return *sampler_; }
  const RoughSurface<T>& surface() const noexcept { return surface_; }

  /// Draws a unit normal seen from `wi`.
  Vec3<T> sample(const Vec3<T>& wi, T u1, T u2) const noexcept {
    if (surface_.is_flat()) return sampler_->sample(wi, surface_.alpha(), u1, u2);
    if constexpr (requires { sampler_->sample(wi, surface_, u1, u2); })
      return sampler_->sample(wi, surface_, u1, u2);  // normalises once
    const Vec3<T> m = sampler_->sample(direction(wi), surface_.alpha(), u1, u2);
    return normalize_or_up(surface_.tilted_normal(m));
  }

  /// The direction `wi`, from which many normals can be drawn (Kernel::at()).
  auto at(const Vec3<T>& wi) const noexcept { return sampler_->at(wi, surface_); }

  /// A normal with the density that the sampler's map has there. On a surface that is not flat it
  /// is that of sample() to rounding.
  SampledNormal<T> sample_with_density(const Vec3<T>& wi, T u1, T u2) const noexcept {
    return surface_.tilted(sampler_->sample_with_density(direction(wi), surface_.alpha(), u1, u2));
  }

  /// Inverse of sample(): the random numbers that give `wm`, if there are any.
  std::optional<Vec2<T>> invert(const Vec3<T>& wi, const Vec3<T>& wm) const noexcept {
    return sampler_->invert(direction(wi), normal(wm).unit, surface_.alpha());
  }

  /// Density of sample() per solid angle.
  T pdf(const Vec3<T>& wi, const Vec3<T>& wm) const noexcept {
    const FlatNormal m = normal(wm);
    return sampler_->pdf(direction(wi), m.unit, surface_.alpha()) / m.cube();
  }

  /// The distribution of normals D(wm) per solid angle.
  T d(const Vec3<T>& wm) const noexcept {
    const FlatNormal m = normal(wm);
    return sampler_->d(m.unit, surface_.alpha()) / (m.length * m.cube());
  }

  /// Smith's Lambda(w) relative to the mean normal.
  T lambda(const Vec3<T>& w) const noexcept {
    return sampler_->lambda(direction(w), surface_.alpha());
  }
  /// Smith's masking G1(w) = 1 / (1 + Lambda(w)) relative to the mean normal.
  T g1(const Vec3<T>& w) const noexcept { return sampler_->g1(direction(w), surface_.alpha()); }

  /// Projected area of the facets that face `w`, on either side of the surface, per area of it.
  T visible_area(const Vec3<T>& w) const noexcept {
    if (surface_.is_flat()) return sampler_->visible_area(w, surface_.alpha());
    const Vec3<T> flat = surface_.flattened_direction(w);
    return std::sqrt(dot(flat, flat)) * sampler_->visible_area(direction(w), surface_.alpha());
  }

  /// The unit direction to the flat surface.
  Vec3<T> direction(const Vec3<T>& w) const noexcept {
    return surface_.is_flat() ? w : normalize_or_up(surface_.flattened_direction(w));
  }

  /// The unit normal of the flat surface, and the length that it had.
  struct FlatNormal {
    Vec3<T> unit;
    T length;
    T cube() const { return length * length * length; }
  };
  FlatNormal normal(const Vec3<T>& wm) const noexcept {
    if (surface_.is_flat()) return {wm, T(1)};
    const Vec3<T> m = surface_.flattened_normal(wm);
    return {normalize_or_up(m), std::sqrt(dot(m, m))};
  }

 private:
  const Sampler* sampler_;
  RoughSurface<T> surface_;
};

}  // namespace vndf
