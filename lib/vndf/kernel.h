// What a renderer uses: visible normals at any roughness and incidence, and D, Lambda, G1 and the
// density, from baked tables (Heitz and d'Eon 2014, Algorithm 4 and equations 1 to 3). A Kernel is
// a view of a block in memory, which it does not own, and holds a few dozen numbers: copy it
// freely, also to another thread or device. kernel_text.h has the functions themselves, for any
// language.
//
// In every function directions are unit vectors of the shading frame (vec.h), alpha is in the units
// of the distribution's own definition and densities are per solid angle. alpha > 0 is tested from
// 1e-4 to 10 at ratios up to 1:1000; any u is moved into [2^-25, 1 - 2^-24]. For an input outside
// its range (alpha <= 0, a component that is not a number) each function returns the fallback that
// it states; no function allocates or throws. wi may be any direction, also below the horizon, as a
// walk inside the microsurface needs it. How far the sampled distribution is from the exact one is
// in the certificate of its tables (certificate.h).
#pragma once

#include <optional>

#include "vndf/kernel_language.h"
#include "vndf/rough_surface.h"
#include "vndf/vec.h"

namespace vndf {

namespace kernel {
#include "vndf/kernel_text.h"
}  // namespace kernel

class Kernel;

/// A kernel after step 1 of Algorithm 4, which depends on the direction and the surface alone, for
/// many normals seen from one direction: at(wi, surface).sample(u1, u2) is Kernel::sample(wi,
/// surface, u1, u2) bit for bit.
class KernelDirection {
 public:
  /// Draws a normal, as Kernel::sample() does.
  VNDF_DEVICE Vec3<float> sample(float u1, float u2) const noexcept {
    const Vec3<float> m = kernel::vndf_drawn(tables_, direction_, u1, u2);
    return kernel::vndf_unit_or_up(is_flat_ ? m : surface_.tilted_normal(m));
  }
  /// Draws a normal with its density, as Kernel::sample_with_density() does.
  VNDF_DEVICE SampledNormal<float> sample_with_density(float u1, float u2) const noexcept {
    const auto sampled = kernel::vndf_sample_with_density(tables_, direction_, u1, u2);
    return surface_.tilted({sampled.wm, sampled.pdf});
  }

  /// What batches and other languages need of it: arguments of vndf_sample(), and the surface that
  /// tilts its normals.
  struct View {
    const kernel::VndfTables& tables;
    const kernel::VndfDirection& direction;
    const RoughSurface<float>& surface;
  };
  VNDF_DEVICE View view() const { return {tables_, direction_, surface_}; }

 private:
  friend class Kernel;
  VNDF_DEVICE KernelDirection(const kernel::VndfTables& tables, const Vec3<float>& wi,
                              const RoughSurface<float>& surface) noexcept
      : tables_(tables),
        direction_(kernel::vndf_at(tables, surface.is_flat() ? wi : surface.flattened_direction(wi),
                                   surface.alpha().x, surface.alpha().y)),
        surface_(surface),
        is_flat_(surface.is_flat()) {}

  // A copy, because normals that are written might change what a reference refers to.
  kernel::VndfTables tables_;
  kernel::VndfDirection direction_;
  RoughSurface<float> surface_;
  bool is_flat_;
};

class Kernel {
 public:
  using Scalar = float;
  static constexpr bool kVisible = true;

  /// For KernelTables::kernel(), which knows that nothing is read outside the block.
  VNDF_DEVICE explicit Kernel(const kernel::VndfTables& tables) : tables_(tables) {}

  /// What batches and other languages need of it: the first argument of every function of
  /// kernel_text.h.
  VNDF_DEVICE const kernel::VndfTables& tables() const { return tables_; }

  /// Step 1: the direction `wi`, stretched, from which many normals can be drawn. Any input is
  /// accepted; the functions of the result then return their fallbacks.
  VNDF_DEVICE KernelDirection at(const Vec3<float>& wi, const Alpha<float>& alpha) const noexcept {
    return at(wi, RoughSurface<float>(alpha));
  }
  /// The same for a surface with correlated slopes or a mean slope (rough_surface.h).
  VNDF_DEVICE KernelDirection at(const Vec3<float>& wi,
                                 const RoughSurface<float>& surface) const noexcept {
    return {tables_, wi, surface};
  }

  /// Draws a normal visible from `wi`. slope_x increases with u1 and slope_y with u2 in
  /// the frame of the stretched incident direction; at an exact pole its azimuth is taken as 0.
  /// Returns a unit normal, to kLengthSlack<float>, with wm.z > 0 and dot(wi, wm) >=
  /// -kFacingSlack<float>; (0, 0, 1) for an input outside its range. From below the horizon it is
  /// also (0, 0, 1) where nothing is visible: where slopes are bounded, from directions that see
  /// less than 1e-13 of the surface, and where the tables were baked without below_horizon.
  /// Straight from below infinite slopes are visible, and the normal is horizontal, but for
  /// rounding, as it is in the limit along azimuth 0.
  VNDF_DEVICE Vec3<float> sample(const Vec3<float>& wi, const Alpha<float>& alpha, float u1,
                                 float u2) const noexcept {
    return kernel::vndf_sample_towards(tables_, wi, alpha.x, alpha.y, u1, u2);
  }

  /// The same for a surface with correlated slopes or a mean slope; OnSurface (on_surface.h) has
  /// the other functions for it. A surface that is flat has the normals of its alpha, to rounding.
  VNDF_DEVICE Vec3<float> sample(const Vec3<float>& wi, const RoughSurface<float>& surface,
                                 float u1, float u2) const noexcept {
    const Alpha<float>& alpha = surface.alpha();
    const Vec3<float> w = surface.flattened_direction(wi);
    const Vec3<float> m = kernel::vndf_drawn_towards(tables_, w, alpha.x, alpha.y, u1, u2);
    return kernel::vndf_unit_or_up(surface.tilted_normal(m));
  }

  /// The normal of sample() with the density that the map has there, the reciprocal of its
  /// Jacobian. An estimate that divides by this density rather than by pdf() has no error of the
  /// tables: the mean of f(wm) / density is the integral of f over the normals that the map
  /// reaches. The density is >= 0 and finite; 0 for an input outside its range. Where many u give
  /// the same normal it is the largest finite number, and those samples get negligible weight.
  VNDF_DEVICE SampledNormal<float> sample_with_density(const Vec3<float>& wi,
                                                       const Alpha<float>& alpha, float u1,
                                                       float u2) const noexcept {
    return at(wi, alpha).sample_with_density(u1, u2);
  }

  /// Inverse of sample(): the (u1, u2) that give `wm`, one of them where many do. Returns nothing
  /// where there is none, to kVndfRangeSlack, or where an input is outside its range. It bisects,
  /// and takes about 60 times as long as sample().
  std::optional<Vec2<float>> invert(const Vec3<float>& wi, const Vec3<float>& wm,
                                    const Alpha<float>& alpha) const noexcept {
    if (!kernel::vndf_valid(wi, alpha.x, alpha.y) || !(wm.z > 0.0f)) return {};
    const auto inverse = kernel::vndf_invert(tables_, at(wi, alpha).direction_, wm);
    if (!inverse.found) return {};
    return Vec2<float>{inverse.u1, inverse.u2};
  }

  /// Density of normals D(wm) per solid angle; 0 for a horizontal or back-facing normal.
  VNDF_DEVICE float d(const Vec3<float>& wm, const Alpha<float>& alpha) const noexcept {
    return kernel::vndf_d(tables_, wm, alpha.x, alpha.y);
  }

  /// Smith's Lambda(w) of the direction or its mirror below the horizon; infinite at the
  /// horizon and next to it, where it is beyond the largest float.
  VNDF_DEVICE float lambda(const Vec3<float>& w, const Alpha<float>& alpha) const noexcept {
    return kernel::vndf_lambda(tables_, w, alpha.x, alpha.y);
  }

  /// Smith's masking G1(w) = 1 / (1 + Lambda(w)); 0 for an input outside its range.
  VNDF_DEVICE float g1(const Vec3<float>& w, const Alpha<float>& alpha) const noexcept {
    return kernel::vndf_g1(tables_, w, alpha.x, alpha.y);
  }

  /// Projected area of the facets that face `w`, per area of the surface: w.z (1 + Lambda(w)) above
  /// the horizon and |w.z| Lambda(w) below it; 0 for an input outside its range.
  VNDF_DEVICE float visible_area(const Vec3<float>& w, const Alpha<float>& alpha) const noexcept {
    return kernel::vndf_visible_area(tables_, w, alpha.x, alpha.y);
  }

  /// Density of the exact distribution per solid angle, D_wi(wm) = dot(wi, wm)+ D(wm) over the
  /// visible area of wi (equation 2); 0 for an input outside its range and where nothing is
  /// visible.
  VNDF_DEVICE float pdf(const Vec3<float>& wi, const Vec3<float>& wm,
                        const Alpha<float>& alpha) const noexcept {
    return kernel::vndf_pdf(tables_, wi, wm, alpha.x, alpha.y);
  }

 private:
  kernel::VndfTables tables_;
};

}  // namespace vndf
