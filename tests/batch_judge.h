// How far a normal may be from the one that TabulatedSampler<float> draws (sample_batch.h).
#pragma once

#include <algorithm>
#include <cmath>

#include "batch/sample_batch.h"
#include "random_inputs.h"
#include "vndf/tabulated_sampler.h"

namespace vndf::test {

/// Distance on the unit sphere, for small angles the angle in radians, of two normals brought to
/// unit roughness and mean slope.
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

class BatchJudge {
 public:
  explicit BatchJudge(const std::shared_ptr<const SlopeTables>& tables)
      : single_(tables), double_(tables) {}

  const TabulatedSampler<float>& sampler() const { return single_; }

  /// Angle from the scalar sample, less that by which a change of u1 and u2 by kBatchUError turns
  /// the normal: at most allowed() for a batch as promised.
  double excess(const Vec3<float>& m, const SamplerInput& in) const {
    const double mu = single_.tables().mean_slope;
    const Alpha<double> unit{in.alpha.x * mu, in.alpha.y * mu};
    const auto exact = double_.sample(in.wi, in.alpha, in.u1, in.u2);
    double by_u = 0;
    for (const double s1 : {-kBatchUError, 0.0, kBatchUError})
      for (const double s2 : {-kBatchUError, 0.0, kBatchUError}) {
        const auto moved =
            double_.sample(in.wi, in.alpha, probability(in.u1).u + s1, probability(in.u2).u + s2);
        by_u = std::max(by_u, stretched_angle(moved, exact, unit));
      }
    return stretched_angle(m, scalar(in), unit) - by_u;
  }

  double allowed() const { return kBatchAngle * single_.tables().tail_order; }

  Vec3<float> scalar(const SamplerInput& in) const {
    return single_.sample(wi(in), alpha(in), static_cast<float>(in.u1), static_cast<float>(in.u2));
  }
  static Vec3<float> wi(const SamplerInput& in) {
    return {static_cast<float>(in.wi.x), static_cast<float>(in.wi.y), static_cast<float>(in.wi.z)};
  }
  static Alpha<float> alpha(const SamplerInput& in) {
    return {static_cast<float>(in.alpha.x), static_cast<float>(in.alpha.y)};
  }

 private:
  TabulatedSampler<float> single_;
  TabulatedSampler<double> double_;
};

/// Inputs and results of a batch.
struct BatchArrays {
  std::vector<float> wi_x, wi_y, wi_z, alpha_x, alpha_y, u1, u2, x, y, z;

  void add(const Vec3<float>& wi, const Alpha<float>& alpha, float first, float second) {
    wi_x.push_back(wi.x);
    wi_y.push_back(wi.y);
    wi_z.push_back(wi.z);
    alpha_x.push_back(alpha.x);
    alpha_y.push_back(alpha.y);
    add(first, second);
  }
  /// A sample alone, for a direction that is already there.
  void add(float first, float second) {
    u1.push_back(first);
    u2.push_back(second);
    for (auto* v : {&x, &y, &z}) v->push_back(-9);
  }
  void add(const SamplerInput& in) {
    add(BatchJudge::wi(in), BatchJudge::alpha(in), static_cast<float>(in.u1),
        static_cast<float>(in.u2));
  }

  std::size_t size() const { return u1.size(); }
  DirectionSpans wi() const { return {wi_x, wi_y, wi_z}; }
  AlphaSpans alpha() const { return {alpha_x, alpha_y}; }
  NormalSpans wm() { return {x, y, z}; }
  Vec3<float> normal(std::size_t i) const { return {x[i], y[i], z[i]}; }
  void sample(const TabulatedSampler<float>& sampler, std::size_t per_direction = 1) {
    sample_batch(sampler, wi(), alpha(), u1, u2, wm(), per_direction);
  }
};

}  // namespace vndf::test
