// Sampling and evaluating the distribution of visible normals from baked tables: what a renderer
// uses. A Kernel is a view, a few dozen numbers and the place of the block in memory, which it does
// not own: copy it freely, also to another thread or device. The functions are those of
// kernel_text.h.
//
// Inputs of every function: directions are unit vectors; alpha > 0, tested from 1e-4 to 10 at
// ratios up to 1:1000; any u, which is moved into [2^-25, 1 - 2^-24]. An input outside its range
// (alpha <= 0, a component that is not a number, wi below the horizon) gives the stated fallback
// and nothing else happens: no function allocates or throws.
#pragma once

#include <optional>

#include "vndf/kernel_language.h"
#include "vndf/vec.h"

namespace vndf {

namespace kernel {
#include "vndf/kernel_text.h"
}  // namespace kernel

/// Smallest dot(wi, wm) of a sampled normal: rounding; the exact value is never negative.
inline constexpr float kKernelFacingSlack = 4 * 0x1p-23f;

/// Largest difference of the length of a sampled normal from 1.
inline constexpr float kKernelLengthSlack = 4 * 0x1p-23f;

class Kernel;

/// One direction and roughness, the result of step 1 of Algorithm 4, from which many normals are
/// drawn: Kernel::sample(wi, alpha, u1, u2) is at(wi, alpha).sample(u1, u2), bit for bit.
class KernelDirection {
 public:
  /// Draws a normal as Kernel::sample() does.
  Vec3<float> sample(float u1, float u2) const noexcept {
    return kernel::vndf_sample(tables_, direction_, u1, u2);
  }
  /// The normal of sample(), with the density of the map there (Kernel::sample_with_density()).
  SampledNormal<float> sample_with_density(float u1, float u2) const noexcept {
    const auto sampled = kernel::vndf_sample_with_density(tables_, direction_, u1, u2);
    return {sampled.wm, sampled.pdf};
  }

  const kernel::VndfDirection& direction() const { return direction_; }
  /// Those of its kernel.
  const kernel::VndfTables& tables() const { return tables_; }

 private:
  friend class Kernel;
  KernelDirection(const kernel::VndfTables& tables, const Vec3<float>& wi,
                  const Alpha<float>& alpha) noexcept

      : tables_(tables), direction_(kernel::vndf_at(tables, wi, alpha.x, alpha.y)) {}

  // A copy, so that it stays in registers while normals are written.
  kernel::VndfTables tables_;
  kernel::VndfDirection direction_;
};

class Kernel {
 public:
  using Scalar = float;
  static constexpr bool kVisible = true;

  /// For KernelTables, which has checked that nothing is read outside the block.
  explicit Kernel(const kernel::VndfTables& tables) : tables_(tables) {}

  /// The view itself, for batches and for other devices.
  const kernel::VndfTables& tables() const { return tables_; }

  /// Step 1: `wi` stretched.
  KernelDirection at(const Vec3<float>& wi, const Alpha<float>& alpha) const noexcept {
    return {tables_, wi, alpha};
  }

  /// Draws a normal visible from `wi` (wi.z >= 0). slope_x increases with u1 and slope_y with u2 in
  /// the frame of the stretched incident direction; at the exact pole its azimuth is taken as 0.
  /// Returns a unit normal, to kKernelLengthSlack, with wm.z > 0 and dot(wi, wm) >=
  /// -kKernelFacingSlack; (0, 0, 1) for an input outside its range.
  Vec3<float> sample(const Vec3<float>& wi, const Alpha<float>& alpha, float u1,
                     float u2) const noexcept {
    return kernel::vndf_sample_towards(tables_, wi, alpha.x, alpha.y, u1, u2);
  }

  /// The normal of sample(), with the density of the map there: the reciprocal of its Jacobian. The
  /// mean of f(wm) / pdf is the integral of f over the normals that the map reaches, with no error
  /// of the tables. pdf is >= 0 and finite; 0 for an input outside its range; the largest number
  /// where many u give one normal, so that such u weigh nothing.
  SampledNormal<float> sample_with_density(const Vec3<float>& wi, const Alpha<float>& alpha,
                                           float u1, float u2) const noexcept {
    return at(wi, alpha).sample_with_density(u1, u2);
  }

  /// The (u1, u2) for which sample() gives `wm`; nothing where there is none or an input is outside
  /// its range.
  std::optional<Vec2<float>> invert(const Vec3<float>& wi, const Vec3<float>& wm,
                                    const Alpha<float>& alpha) const noexcept {
    if (!kernel::vndf_valid(wi, alpha.x, alpha.y) || !(wm.z > 0.0f)) return {};
    const auto inverse = kernel::vndf_invert(tables_, at(wi, alpha).direction(), wm);
    if (!inverse.found) return {};
    return Vec2<float>{inverse.u1, inverse.u2};
  }

  /// Density of normals D(wm) per solid angle; 0 for a horizontal or back-facing normal.
  float d(const Vec3<float>& wm, const Alpha<float>& alpha) const noexcept {
    return kernel::vndf_d(tables_, wm, alpha.x, alpha.y);
  }

  /// Smith's Lambda(w) of the direction or its mirror below the horizon; infinite at the horizon.
  float lambda(const Vec3<float>& w, const Alpha<float>& alpha) const noexcept {
    return kernel::vndf_lambda(tables_, w, alpha.x, alpha.y);
  }

  /// Smith's masking G1(w) = 1 / (1 + Lambda(w)); 0 for an input outside its range.
  float g1(const Vec3<float>& w, const Alpha<float>& alpha) const noexcept {
    return kernel::vndf_g1(tables_, w, alpha.x, alpha.y);
  }

  /// Density of the exact law per solid angle, D_wi(wm) = dot(wi, wm)+ D(wm) / (wi.z (1 +
  /// Lambda(wi))) (Heitz and d'Eon 2014, equation 2), finite up to the horizon; 0 for an input
  /// outside its range.
  float pdf(const Vec3<float>& wi, const Vec3<float>& wm,
            const Alpha<float>& alpha) const noexcept {
    return kernel::vndf_pdf(tables_, wi, wm, alpha.x, alpha.y);
  }

 private:
  kernel::VndfTables tables_;
};

}  // namespace vndf
