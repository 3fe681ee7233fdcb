// The kernel of caps_batch(), compiled once for each target.
#include "vndf/bench/caps_batch.h"

#include <numbers>

#include "vndf/batch/batch_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "vndf/bench/caps_batch.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <hwy/contrib/math/math-inl.h>

HWY_BEFORE_NAMESPACE();
namespace vndf::bench::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, batch::kMaxLanes>;
using V = hn::Vec<Floats>;
constexpr Floats d;

V set(float x) {
  return hn::Set(d, x);
}

/// 1 / |(x, y, z)|.
V inverse_length(V x, V y, V z) {
  const V square = hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(z, z)));
  return hn::Div(set(1.0f), hn::Sqrt(square));
}

struct Normal {
  V x, y, z;
};

/// The stretched direction plus a point of the cap that it lights.
Normal caps(V x, V y, V z, V alpha_x, V alpha_y, V u1, V u2) {
  const V sx = hn::Mul(x, alpha_x), sy = hn::Mul(y, alpha_y);
  const V scale = inverse_length(sx, sy, z);
  const V cos = hn::Mul(z, scale);
  const V phi = hn::Mul(set(2 * std::numbers::pi_v<float>), u1);
  const V height = hn::MulSub(hn::Sub(set(1.0f), u2), hn::Add(set(1.0f), cos), cos);
  const V below_one = hn::NegMulAdd(height, height, set(1.0f));
  const V radius = hn::Sqrt(hn::Min(hn::Max(below_one, hn::Zero(d)), set(1.0f)));
  const V m_x = hn::Mul(alpha_x, hn::MulAdd(radius, hn::Cos(d, phi), hn::Mul(sx, scale)));
  const V m_y = hn::Mul(alpha_y, hn::MulAdd(radius, hn::Sin(d, phi), hn::Mul(sy, scale)));
  const V m_z = hn::Add(height, cos);
  const V unit = inverse_length(m_x, m_y, m_z);
  return {hn::Mul(m_x, unit), hn::Mul(m_y, unit), hn::Mul(m_z, unit)};
}

void caps_directions(batch::DirectionInputs& inputs, batch::Samples& samples) {
  for (std::size_t begin = 0; begin < samples.size; begin += batch::kBlock) {
    const float *x = inputs.x.block(begin), *y = inputs.y.block(begin), *z = inputs.z.block(begin);
    const float *ax = inputs.alpha_x.block(begin), *ay = inputs.alpha_y.block(begin);
    const float *u1 = samples.u1.block(begin), *u2 = samples.u2.block(begin);
    float *out_x = samples.x.block(begin), *out_y = samples.y.block(begin),
          *out_z = samples.z.block(begin);
    for (std::size_t i = 0; i < batch::kBlock; i += hn::Lanes(d)) {
      const auto at = [i](const float* from) HWY_ATTR { return hn::LoadU(d, from + i); };
      const Normal m = caps(at(x), at(y), at(z), at(ax), at(ay), at(u1), at(u2));
      hn::StoreU(m.x, d, out_x + i);
      hn::StoreU(m.y, d, out_y + i);
      hn::StoreU(m.z, d, out_z + i);
    }
    samples.x.finish(begin);
    samples.y.finish(begin);
    samples.z.finish(begin);
  }
}

}  // namespace
}  // namespace vndf::bench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vndf::bench {
namespace {

HWY_EXPORT(caps_directions);

/// One direction for all samples, or one for each: `Direction` and `Roughness` are vectors or
/// spans.
template <class Direction, class Roughness>
void dispatch(const Direction& wi, const Roughness& alpha, std::span<const float> u1,
              std::span<const float> u2, const NormalSpans& wm) {
  using batch::Input;
  using batch::Output;
  batch::Samples samples{wm.x.size(),  Input(u1),    Input(u2),
                         Output(wm.x), Output(wm.y), Output(wm.z)};
  batch::DirectionInputs inputs{Input(wi.x), Input(wi.y), Input(wi.z), Input(alpha.x),
                                Input(alpha.y)};
  HWY_DYNAMIC_DISPATCH(caps_directions)(inputs, samples);
}

}  // namespace

void caps_batch(const DirectionSpans& wi, const AlphaSpans& alpha, std::span<const float> u1,
                std::span<const float> u2, const NormalSpans& wm) {
  dispatch(wi, alpha, u1, u2, wm);
}

void caps_batch(const Vec3<float>& wi, const Alpha<float>& alpha, std::span<const float> u1,
                std::span<const float> u2, const NormalSpans& wm) {
  dispatch(wi, alpha, u1, u2, wm);
}

}  // namespace vndf::bench
#endif  // HWY_ONCE
