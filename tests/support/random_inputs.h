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
  /// 1e-7 degrees, or at either, or so close that the small components are denormal in single
  /// precision; the azimuth uniform or along an axis; u uniform, or 0, the smallest float, 1 -
  /// 2^-24 or 1.
  SamplerInput hard() {
    return {hard_direction(), {hard_alpha(), hard_alpha()}, hard_u(), hard_u()};
  }
  /// The same, and of each two directions one below the horizon.
  SamplerInput hard_anywhere() {
    SamplerInput in = hard();
    if (uniform() < 0.5) in.wi.z = -in.wi.z;
    return in;
  }

 private:
  double hard_alpha() { return std::pow(10, -4 + 5 * uniform()); }
  double hard_u() {
    const double choice = uniform();
    if (choice < 0.05) return 0;
    if (choice < 0.1) return 1;
    if (choice < 0.13) return 1 - std::ldexp(1, -24);
    return choice < 0.15 ? std::ldexp(1, -149) : uniform();
  }
  Vec2<double> hard_azimuth() {
    constexpr Vec2<double> kAxes[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    if (uniform() < 0.1) return kAxes[static_cast<int>(4 * uniform())];
    const double phi = 2 * std::numbers::pi * uniform();
    return {std::cos(phi), std::sin(phi)};
  }
  Vec3<double> hard_direction() {
    const double choice = uniform(), tiny = std::pow(10, -45 * uniform()),
                 rest = std::sqrt((1 - tiny) * (1 + tiny));
    const Vec2<double> turn = hard_azimuth();
    const auto direction = [&](double sine, double cosine) {
      return Vec3<double>{sine * turn.x, sine * turn.y, cosine};
    };
    if (choice < 0.05) return direction(0, 1);
    if (choice < 0.1) return direction(1, 0);
    if (choice < 0.2) return direction(tiny, rest);
    if (choice < 0.3) return direction(rest, tiny);
    const double theta = hard_angle() * std::numbers::pi / 180;
    return direction(std::sin(theta), std::cos(theta));
  }
  double hard_angle() {
    const double choice = uniform();
    if (choice < 0.5) return 90 * uniform();
    const double distance = std::pow(10, -1 - std::floor(7 * uniform()));
    return choice < 0.85 ? 90 - distance : distance;
  }

  std::mt19937_64 random_;
};

}  // namespace vndf::test
