// Inputs and results of a batch of normals, and every target that may draw it.
#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include <hwy/highway.h>

#include "support/random_inputs.h"
#include "vndf/batch/spans.h"
#include "vndf/vec.h"

namespace vndf::test {

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
    const auto number = [](double value) { return static_cast<float>(value); };
    add({number(in.wi.x), number(in.wi.y), number(in.wi.z)},
        {number(in.alpha.x), number(in.alpha.y)}, number(in.u1), number(in.u2));
  }

  std::size_t size() const { return u1.size(); }
  DirectionSpans wi() const { return {wi_x, wi_y, wi_z}; }
  AlphaSpans alpha() const { return {alpha_x, alpha_y}; }
  NormalSpans wm() { return {x, y, z}; }
  Vec3<float> wi(std::size_t i) const { return {wi_x[i], wi_y[i], wi_z[i]}; }
  Alpha<float> alpha(std::size_t i) const { return {alpha_x[i], alpha_y[i]}; }
  Vec3<float> normal(std::size_t i) const { return {x[i], y[i], z[i]}; }
};

/// Distance of two unit normals, for small angles the angle in radians.
inline double angle_between(const Vec3<float>& a, const Vec3<double>& b) {
  return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

/// Runs `f` with batches on each target of this processor in turn.
inline void for_each_target(const std::function<void(const char* target)>& f) {
  for (const auto target : hwy::SupportedAndGeneratedTargets()) {
    hwy::GetChosenTarget().Update(target);
    f(hwy::TargetName(target));
  }
  hwy::GetChosenTarget().DeInit();
}

}  // namespace vndf::test
