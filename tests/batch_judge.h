// Batches beside the scalar kernel, sample by sample.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "batch/sample_batch.h"
#include "random_inputs.h"
#include "vndf/kernel.h"

namespace vndf::test {

/// Distance on the unit sphere, for small angles the angle in radians, of two normals brought to
/// unit roughness.
template <class A, class B>
double stretched_angle(const Vec3<A>& a, const Vec3<B>& b, const Alpha<double>& unit_alpha) {
  const auto stretched = [&](double x, double y, double z) {
    const Vec3<double> m{x / unit_alpha.x, y / unit_alpha.y, z};
    const double length = std::sqrt(dot(m, m));
    return Vec3<double>{m.x / length, m.y / length, m.z / length};
  };
  const Vec3<double> p = stretched(a.x, a.y, a.z), q = stretched(b.x, b.y, b.z);
  return std::hypot(p.x - q.x, p.y - q.y, p.z - q.z);
}

/// Whether they are one vector to the last bit, the sign of 0 included.
inline bool same_bits(const Vec3<float>& a, const Vec3<float>& b) {
  const auto same = [](float p, float q) {
    return std::bit_cast<std::uint32_t>(p) == std::bit_cast<std::uint32_t>(q);
  };
  return same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z);
}

/// Inputs and results of a batch.
struct BatchArrays {
  std::vector<float> wi_x, wi_y, wi_z, alpha_x, alpha_y, u1, u2, x, y, z;

  void add(const Vec3<float>& wi, const Alpha<float>& alpha, float first, float second) {
    wi_x.push_back(wi.x);
    wi_y.push_back(wi.y);
    wi_z.push_back(wi.z);
    alpha_x.push_back(alpha.x);
    alpha_y.push_back(alpha.y);
    u1.push_back(first);
    u2.push_back(second);
    for (auto* v : {&x, &y, &z}) v->push_back(-9);
  }
  void add(const SamplerInput& in) {
    add({static_cast<float>(in.wi.x), static_cast<float>(in.wi.y), static_cast<float>(in.wi.z)},
        {static_cast<float>(in.alpha.x), static_cast<float>(in.alpha.y)}, static_cast<float>(in.u1),
        static_cast<float>(in.u2));
  }

  std::size_t size() const { return u1.size(); }
  DirectionSpans wi() const { return {wi_x, wi_y, wi_z}; }
  AlphaSpans alpha() const { return {alpha_x, alpha_y}; }
  NormalSpans wm() { return {x, y, z}; }
  Vec3<float> wi(std::size_t i) const { return {wi_x[i], wi_y[i], wi_z[i]}; }
  Alpha<float> alpha(std::size_t i) const { return {alpha_x[i], alpha_y[i]}; }
  Vec3<float> normal(std::size_t i) const { return {x[i], y[i], z[i]}; }

  void sample(const Kernel& kernel) { sample_batch(kernel, wi(), alpha(), u1, u2, wm()); }

  /// How many normals are not those of the scalar kernel, bit for bit.
  std::size_t differences(const Kernel& kernel) const {
    std::size_t count = 0;
    for (std::size_t i = 0; i < size(); ++i)
      if (!same_bits(normal(i), kernel.sample(wi(i), alpha(i), u1[i], u2[i]))) ++count;
    return count;
  }
};

/// `n` random inputs, hard ones among them.
inline BatchArrays hard_batch(std::size_t n) {
  RandomInputs random(11);
  BatchArrays batch;
  for (std::size_t i = 0; i < n; ++i) batch.add(random.hard());
  return batch;
}

}  // namespace vndf::test
