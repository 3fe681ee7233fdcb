// Step 1 of Algorithm 4, the stretch, for a block of incident directions, and the rows of patches
// that follow from it.

// Included once for each target: the guard turns over with every one.
#if defined(VNDF_BATCH_DIRECTIONS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef VNDF_BATCH_DIRECTIONS_INL_H
#undef VNDF_BATCH_DIRECTIONS_INL_H
#else
#define VNDF_BATCH_DIRECTIONS_INL_H
#endif

#include <cstddef>

#include <hwy/highway.h>

#include "vndf/batch/batch_kernel.h"
#include "vndf/batch/cells-inl.h"
#include "vndf/batch/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace vndf::batch::HWY_NAMESPACE {
namespace {

/// Directions to the flat surface, of any length.
struct FlattenedBlock {
  Lanes<float> x, y, z;
};

/// RoughSurface::flattened_direction() for a block, which is kept in `flat`.
HWY_INLINE DirectionBlock flatten(const RoughSurface<float>& surface, const DirectionBlock& in,
                                  FlattenedBlock& flat) {
  const V shear = set(surface.shear());
  const V mean_x = set(surface.mean().x), mean_y = set(surface.mean().y);
  for (std::size_t i = 0; i < kBlock; i += hn::Lanes(d)) {
    const V x = hn::LoadU(d, in.x + i), y = hn::LoadU(d, in.y + i);
    store(hn::Add(x, hn::Mul(shear, y)), flat.x, i);
    store(y, flat.y, i);
    store(hn::Sub(hn::Sub(hn::LoadU(d, in.z + i), hn::Mul(mean_x, x)), hn::Mul(mean_y, y)), flat.z,
          i);
  }
  return {flat.x.data(), flat.y.data(), flat.z.data(), in.alpha_x, in.alpha_y};
}

/// kernel::vndf_at for `n` samples.
HWY_INLINE void stretch(const kernel::VndfTables& t, const DirectionBlock& in, std::size_t n,
                        Directions& out) {
  const std::size_t lanes = hn::Lanes(d);
  out.below = 0;
  for (std::size_t i = 0; i < n; i += lanes) {
    for (const float* input : {in.x, in.y, in.z, in.alpha_x, in.alpha_y}) prefetch_ahead(input + i);
    const V alpha_x = hn::LoadU(d, in.alpha_x + i), alpha_y = hn::LoadU(d, in.alpha_y + i);
    const V x = hn::Mul(alpha_x, hn::LoadU(d, in.x + i));
    const V y = hn::Mul(alpha_y, hn::LoadU(d, in.y + i)), z = hn::LoadU(d, in.z + i);
    const V h2 = multiply_add(x, x, hn::Mul(y, y)), zero = hn::Zero(d);
    const auto usual =
        hn::And(hn::And(within(h2, kernel::kVndfShortest, kernel::kVndfLongest), hn::Ge(z, zero)),
                hn::And(hn::Gt(alpha_x, zero), hn::Gt(alpha_y, zero)));
    if (!hn::AllTrue(d, usual)) {
      stretch_each(t, in, i, i + lanes, out);
      continue;
    }
    store(alpha_x, out.alpha_x, i);
    store(alpha_y, out.alpha_y, i);
    store(x, out.x, i);
    store(y, out.y, i);
    store(z, out.z, i);
    store(h2, out.h2, i);
    const V hu = hn::Mul(hn::Sqrt(h2), set(t.unit));
    store(hu, out.hu, i);
    const V g = hn::Add(hn::Div(hu, hn::Add(hu, z)), set(t.direction_offset));
    const CellVector row = cell_of(t.block, t.direction_guide, t.direction_shift, g);
    store(row.f, out.g, i);
    store(row.offset, out.row, i);
  }
}

}  // namespace
}  // namespace vndf::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // guard of the target
