// Evaluates the formula of the sky at the middle of each texel.
#include "render/sky.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace vndf::render {
namespace {

constexpr std::size_t kWidth = 1024, kHeight = 512;
constexpr float kRadian = std::numbers::pi_v<float> / 180;
constexpr float kSunHeight = 40 * kRadian, kSunAzimuth = 220 * kRadian;
constexpr float kSunEven = 1.5f * kRadian, kSunEnd = 4.5f * kRadian;
// The colours were chosen by eye and then scaled until the promises of the header were met.
constexpr Rgb kZenith{0.144f, 0.276f, 0.6f}, kHorizon{0.48f, 0.582f, 0.72f};
constexpr Rgb kGround{0.22f, 0.2f, 0.17f}, kSun{564, 480, 350};

/// From 1 at `begin` down to 0 at `end`, without a corner.
float falling(float x, float begin, float end) {
  const float t = std::clamp((end - x) / (end - begin), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

Rgb sky_colour(const Vector& w) {
  if (w.z < 0) return kGround;
  const Vector sun{std::cos(kSunHeight) * std::cos(kSunAzimuth),
                   std::cos(kSunHeight) * std::sin(kSunAzimuth), std::sin(kSunHeight)};
  const float towards_horizon = (1 - w.z) * (1 - w.z) * (1 - w.z);
  const float angle = 2 * std::asin(std::min(1.0f, length(w - sun) / 2));
  return (1 - towards_horizon) * kZenith + towards_horizon * kHorizon +
         falling(angle, kSunEven, kSunEnd) * kSun;
}

}  // namespace

Image sky_image() {
  Image image{kWidth, kHeight, {}};
  for (std::size_t row = 0; row < kHeight; ++row)
    for (std::size_t column = 0; column < kWidth; ++column) {
      const float angle = 180 * kRadian * (static_cast<float>(row) + 0.5f) / kHeight;
      const float right = 360 * kRadian * ((static_cast<float>(column) + 0.5f) / kWidth - 0.5f);
      image.pixels.push_back(sky_colour(
          {std::sin(angle) * std::sin(right), std::sin(angle) * std::cos(right), std::cos(angle)}));
    }
  return image;
}

}  // namespace vndf::render
