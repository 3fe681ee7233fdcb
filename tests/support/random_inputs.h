// Random inputs for the sampler, the hard ones included.
#pragma once

#include <cmath>
#include <numbers>
#include <random>

#include "vndf/vec.h"

namespace vndf::test {

struct SamplerInput {
  Vec3<double> wi;
  Alpha<double> alpha;
  double u1, u2;
};

class RandomInputs {
 public:
  explicit RandomInputs(std::uint64_t seed) : random_(seed) {}

  /// A whole multiple of 2^-24 in [0, 1), as single precision generators give.
  double uniform() { return std::ldexp(static_cast<double>(random_() >> 40), -24); }

  /// alpha log-uniform in [1e-4, 10]; theta uniform, or near the pole or the horizon by 1e-1 ...
  /// 1e-7 degrees; u uniform, or 0, or 1 - 2^-24.
  SamplerInput hard() {
    const double theta = hard_angle() * std::numbers::pi / 180;
    const double phi = 2 * std::numbers::pi * uniform();
    return {{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)},
            {hard_alpha(), hard_alpha()},
            hard_u(),
            hard_u()};
  }

 private:
  double hard_alpha() { return std::pow(10, -4 + 5 * uniform()); }
  double hard_u() {
    const double choice = uniform();
    return choice < 0.05 ? 0 : choice < 0.1 ? 1 - std::ldexp(1, -24) : uniform();
  }
  double hard_angle() {
    const double choice = uniform();
    if (choice < 0.5) return 90 * uniform();
    const double distance = std::pow(10, -1 - std::floor(7 * uniform()));
    return choice < 0.9 ? 90 - distance : choice < 0.98 ? distance : 0;
  }

  std::mt19937_64 random_;
};

}  // namespace vndf::test
