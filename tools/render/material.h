// What a point of a surface does with light, in its shading frame (frame.h). wi points to where the
// path comes from, the camera's side, and wo to where it goes on. Both are unit vectors away from
// the surface.
#pragma once

#include <numbers>

#include "render/vectors.h"

namespace vndf::render {

/// A direction that a material draws.
struct Scattered {
  Vector wo;
  Rgb weight;     ///< f(wi, wo) |wo.z| / pdf; 0 where the light is lost
  float pdf = 0;  ///< per solid angle of wo; 0 with a weight where wo is the only direction
};

/// Is shared between threads, and does not change.
class Material {
 public:
  Material() = default;
  Material(const Material&) = delete;
  Material& operator=(const Material&) = delete;
  virtual ~Material() = default;

  /// f(wi, wo) |wo.z|.
  virtual Rgb evaluate(const Vector& wi, const Vector& wo) const = 0;
  /// Density of sample() per solid angle.
  virtual float pdf(const Vector& wi, const Vector& wo) const = 0;
  /// Draws wo by three numbers of [0, 1).
  virtual Scattered sample(const Vector& wi, const Vec2<float>& u, float u3) const = 0;
};

/// A matt surface that reflects the share `albedo` of the light from above, evenly.
class Matt final : public Material {
 public:
  explicit Matt(const Rgb& albedo) : albedo_(albedo) {}

  Rgb evaluate(const Vector& wi, const Vector& wo) const override { return pdf(wi, wo) * albedo_; }
  float pdf(const Vector& wi, const Vector& wo) const override {
    return wi.z > 0 && wo.z > 0 ? wo.z * std::numbers::inv_pi_v<float> : 0;
  }
  Scattered sample(const Vector& wi, const Vec2<float>& u, float) const override {
    if (!(wi.z > 0)) return {};
    const float azimuth = 2 * std::numbers::pi_v<float> * u.y, sine = std::sqrt(u.x);
    const Vector wo{sine * std::cos(azimuth), sine * std::sin(azimuth), std::sqrt(1 - u.x)};
    return {wo, albedo_, pdf(wi, wo)};
  }

 private:
  Rgb albedo_;
};

}  // namespace vndf::render
