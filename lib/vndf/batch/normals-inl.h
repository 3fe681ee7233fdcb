// Steps 2 to 5 of Algorithm 4 for a block of samples whose incident directions are known: the two
// lookups that give a slope, and the normal of the slope.

// Included once for each target: the guard turns over with every one.
#if defined(VNDF_BATCH_NORMALS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef VNDF_BATCH_NORMALS_INL_H
#undef VNDF_BATCH_NORMALS_INL_H
#else
#define VNDF_BATCH_NORMALS_INL_H
#endif

#include <cstddef>
#include <cstdint>

#include <hwy/highway.h>

#include "vndf/batch/batch_kernel.h"
#include "vndf/batch/blocks.h"
#include "vndf/batch/cells-inl.h"
#include "vndf/batch/vectors-inl.h"
#include "vndf/kernel.h"

HWY_BEFORE_NAMESPACE();
namespace vndf::batch::HWY_NAMESPACE {
namespace {

/// Everything between the incident directions of a block and its normals, in short loops: one that
/// waits for a table or a root then has the next samples at hand.
class Sampling {
 public:
  Sampling(const kernel::VndfTables& tables, Samples& samples)
      : t_(tables), samples_(samples), is_flat_(samples.surface.is_flat()) {}

  /// The normals of the block that begins at sample `begin`.
  void block(std::size_t begin, const Directions& directions) {
    const std::size_t n = block_size(begin, samples_.size);
    // 2. sample the slope of the stretched configuration
    const float *u1 = samples_.u1.block(begin), *u2 = samples_.u2.block(begin);
    place_columns(directions, u1, u2, n);
    if (t_.separable != 0) {
      draw_root(directions, n);
      draw_separable_y(n);
    } else {
      place_slopes(directions, n);
      fetch_slope_cells(n);
      draw_mapped_root(n);
      draw_slope_y(n);
    }
    // 3. rotate, 4. unstretch, 5. compute the normal
    float *x = samples_.x.block(begin), *y = samples_.y.block(begin), *z = samples_.z.block(begin);
    write_normals(directions, n, x, y, z);
    if (directions.below != 0)
      sample_each_below(t_, directions, samples_.surface, n, u1, u2, x, y, z);
    samples_.x.finish(begin);
    samples_.y.finish(begin);
    samples_.z.finish(begin);
  }

 private:
  struct Column {
    V place;
    W upper;  ///< all bits where u is above one half
  };

  /// The place of u on the axis of columns; `apart` is added to its bits above one half, and adding
  /// and taking away 1.5 x 2^23 rounds to a whole number: q = u below one half, u - 1 above.
  HWY_INLINE Column column(V u, std::uint32_t apart) const {
    const V whole = set(12582912.0f);
    u = hn::Min(hn::Max(u, set(kernel::kVndfLeastU)), set(kernel::kVndfMostU));
    V q = hn::Sub(u, hn::Sub(hn::Add(u, whole), whole));
    const W upper = sign_mask(q);
    if (t_.column_roots != 0) q = root_column(q);
    return {floats_of(hn::Add(bits_of(q), hn::And(upper, set(apart)))), upper};
  }

  /// kernel::vndf_root_columns.
  HWY_INLINE V root_column(V q) const {
    const V p = hn::Add(hn::Sqrt(hn::Abs(hn::Add(q, q))), set(t_.column_offset));
    return hn::CopySignToAbs(p, q);
  }

  /// kernel::vndf_mirrored, of u2.
  HWY_INLINE V mirrored(V place) const {
    const V mirror = hn::Sub(set(t_.column_span), place);
    const W added = hn::And(sign_mask(hn::Sub(mirror, place)), set(t_.column_mirror));
    return floats_of(hn::Add(bits_of(hn::Min(place, mirror)), added));
  }

  HWY_INLINE void place_columns(const Directions& directions, const float* u1, const float* u2,
                                std::size_t n) {
    for (std::size_t i = 0; i < n; i += hn::Lanes(d)) {
      for (const float* input : {u1, u2}) prefetch_ahead(input + i);
      const Column first = column(hn::LoadU(d, u1 + i), t_.column_upper);
      CellVector cell = cell_of(t_.block, t_.marginal_guide, t_.column_shift, first.place);
      cell.offset = hn::Add(cell.offset, load(directions.row, i));
      store(cell, marginal_, i);
      Column second = column(hn::LoadU(d, u2 + i), kernel::kVndfSign);
      if (t_.separable == 0) second.place = mirrored(second.place);
      store(cell_of(t_.block, t_.conditional_guide, t_.column_shift, second.place), conditional_,
            i);
      store(hn::And(second.upper, set(kernel::kVndfSign)), signs_, i);
    }
  }

  /// The cubic of u1 at sample i and those beside it.
  HWY_INLINE V marginal(const Directions& directions, std::size_t i) const {
    return blended_cubics(t_.block, marginal_.offset.data() + i, load(directions.g, i))
        .at(load(marginal_.f, i));
  }

  HWY_INLINE void store_root(V root, std::size_t i) {
    store(hn::Min(hn::Max(root, set(t_.least_root)), set(t_.most_root)), root_, i);
  }

  HWY_INLINE void draw_root(const Directions& directions, std::size_t n) {
    for (std::size_t i = 0; i < n; i += hn::Lanes(d)) store_root(marginal(directions, i), i);
  }

  /// kernel::vndf_slope_place, and where the guide has the entries of its key.
  HWY_INLINE void place_slopes(const Directions& directions, std::size_t n) {
    for (std::size_t i = 0; i < n; i += hn::Lanes(d)) {
      const V w = hn::Sub(set(t_.slope_middle), marginal(directions, i));
      const V p = hn::Min(hn::Add(hn::Abs(w), set(t_.slope_offset)), set(t_.slope_most));
      const W place = hn::Add(bits_of(p), hn::And(sign_mask(w), set(t_.slope_upper)));
      store(floats_of(place), slope_, i);
      const W key = hn::ShiftRightSame(place, static_cast<int>(t_.slope_shift));
      store(hn::Add(hn::ShiftLeft<4>(key), set(t_.slope_guide)), slope_entry_, i);
    }
  }

  /// The cells of the map and of the rows of y, whose entries are four numbers side by side.
  HWY_INLINE void fetch_slope_cells(std::size_t n) {
    for (std::size_t i = 0; i < n; i += hn::Lanes(d)) {
      const V place = load(slope_, i);
      const FourVectors entry = fetch_fours(t_.block, slope_entry_.data() + i);
      store(CellVector{hn::Sub(place, entry.v0), bits_of(entry.v1)}, map_, i);
      store(hn::Sub(place, entry.v2), slope_row_, i);
      store(hn::Add(load(conditional_.offset, i), bits_of(entry.v3)), conditional_.offset, i);
    }
  }

  HWY_INLINE void draw_mapped_root(std::size_t n) {
    for (std::size_t i = 0; i < n; i += hn::Lanes(d))
      store_root(cubics(t_.block, map_.offset.data() + i).at(load(map_.f, i)), i);
  }

  HWY_INLINE void draw_separable_y(std::size_t n) {
    for (std::size_t i = 0; i < n; i += hn::Lanes(d))
      store_slope_y(cubics(t_.block, conditional_.offset.data() + i), i);
  }
  HWY_INLINE void draw_slope_y(std::size_t n) {
    for (std::size_t i = 0; i < n; i += hn::Lanes(d))
      store_slope_y(blended_cubics(t_.block, conditional_.offset.data() + i, load(slope_row_, i)),
                    i);
  }
  HWY_INLINE void store_slope_y(const CubicVector& cubic, std::size_t i) {
    const V v = cubic.at(load(conditional_.f, i));
    store(floats_of(hn::Xor(bits_of(v), load(signs_, i))), v_, i);
  }

  /// kernel::vndf_scale.
  HWY_INLINE V scale(V sigma, V denominator) const {
    if (t_.rim > 0) {
      const V m = hn::Sub(sigma, set(0.5f)), edge = hn::Mul(set(t_.rim), denominator);
      return hn::Sqrt(hn::Max(hn::Mul(hn::Sub(edge, m), hn::Add(edge, m)), hn::Zero(d)));
    }
    return multiply_add(set(t_.scale_root), hn::Sub(set(0.5f), denominator),
                        hn::Mul(set(t_.scale_constant), denominator));
  }

  /// RoughSurface::tilted_normal().
  HWY_INLINE void tilt(V& x, V& y, V z) const {
    const RoughSurface<float>& surface = samples_.surface;
    const V mean_x = set(surface.mean().x), mean_y = set(surface.mean().y);
    y = hn::Sub(hn::Add(y, hn::Mul(set(surface.shear()), x)), hn::Mul(mean_y, z));
    x = hn::Sub(x, hn::Mul(mean_x, z));
  }

  /// kernel::vndf_unstretched, RoughSurface::tilted_normal() and kernel::vndf_unit_or_up.
  HWY_INLINE void write_normals(const Directions& w, std::size_t n, float* out_x, float* out_y,
                                float* out_z) const {
    for (std::size_t i = 0; i < n; i += hn::Lanes(d)) {
      for (const float* output : {out_x, out_y, out_z}) prefetch_ahead(output + i);
      const V one = set(1.0f), root = load(root_, i), sigma = hn::Mul(root, root);
      const V denominator = hn::Mul(sigma, hn::Sub(one, sigma)), hu = load(w.hu, i);
      const V x = hn::Max(hn::Mul(hn::Sub(set(0.5f), sigma), hu),
                          hn::Neg(hn::Mul(denominator, load(w.z, i))));
      const V y = hn::Mul(hn::Mul(scale(sigma, denominator), load(v_, i)), hu);
      const V wx = load(w.x, i), wy = load(w.y, i);
      V m_x = hn::Mul(load(w.alpha_x, i), hn::Add(hn::Mul(wx, x), hn::Mul(wy, y)));
      V m_y = hn::Mul(load(w.alpha_y, i), hn::Sub(hn::Mul(wy, x), hn::Mul(wx, y)));
      const V m_z = hn::Mul(denominator, load(w.h2, i));
      if (!is_flat_) tilt(m_x, m_y, m_z);
      const V square = hn::Add(hn::Add(hn::Mul(m_x, m_x), hn::Mul(m_y, m_y)), hn::Mul(m_z, m_z));
      const V inverse = hn::Div(one, hn::Sqrt(square));
      const auto is_normal = within(square, kernel::kVndfLeast, kernel::kVndfLargest);
      hn::StoreU(hn::IfThenElseZero(is_normal, hn::Mul(m_x, inverse)), d, out_x + i);
      hn::StoreU(hn::IfThenElseZero(is_normal, hn::Mul(m_y, inverse)), d, out_y + i);
      hn::StoreU(hn::IfThenElse(is_normal, hn::Mul(m_z, inverse), one), d, out_z + i);
    }
  }

  const kernel::VndfTables& t_;
  Samples& samples_;
  bool is_flat_;
  Cells marginal_, map_, conditional_;
  Lanes<std::uint32_t> signs_, slope_entry_;
  Lanes<float> slope_;  // place on the axis of slopes
  Lanes<float> root_, slope_row_, v_;
};

}  // namespace
}  // namespace vndf::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // guard of the target
