// Light from far away as a function of direction.
#pragma once

#include <algorithm>
#include <numbers>

#include "render/vectors.h"

namespace vndf::render {

/// Surroundings that are sampled evenly.
class Environment {
 public:
  static Environment constant(const Rgb& radiance) { return Environment(radiance, 0); }
  /// Darker towards the ground.
  static Environment sky() { return Environment({0.6f, 0.7f, 1}, 1); }

  Rgb radiance(const Vector& w) const {
    return (1 - 0.7f * slope_ * (1 - std::max(w.z, 0.0f))) * zenith_;
  }

  struct Sample {
    Vector w;
    Rgb radiance;
    float pdf;
  };
  Sample sample(float u1, float u2) const {
    const float z = 1 - 2 * u1, sine = std::sqrt(std::max(0.0f, 1 - z * z));
    const float azimuth = 2 * std::numbers::pi_v<float> * u2;
    const Vector w{sine * std::cos(azimuth), sine * std::sin(azimuth), z};
    return {w, radiance(w), pdf(w)};
  }
  float pdf(const Vector&) const { return 0.25f * std::numbers::inv_pi_v<float>; }

 private:
  Environment(const Rgb& zenith, float slope) : zenith_(zenith), slope_(slope) {}

  Rgb zenith_;
  float slope_;
};

}  // namespace vndf::render
