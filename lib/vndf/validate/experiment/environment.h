// The light of experiments, which comes from far away as a function of direction: smooth, or with a
// small bright lamp.
#pragma once

#include <cmath>
#include <stdexcept>
#include <string>

#include "vndf/validate/exact/configuration.h"
#include "vndf/vec.h"

namespace vndf::validate {

/// L(w) = 1 + gradient.w + brightness exp(sharpness (lamp.w - 1)), where |gradient| <= 1 and lamp
/// is a unit vector.
struct Environment {
  std::string name;
  Vec3<double> gradient{0, 0, 0};
  Vec3<double> lamp{0, 0, 1};
  double brightness = 0;
  double sharpness = 1;

  /// The radiance from the unit direction `w`.
  double radiance(const Vec3<double>& w) const {
    return 1 + dot(gradient, w) + brightness * std::exp(sharpness * (dot(lamp, w) - 1));
  }
};

/// A sky that is brighter on one side.
inline Environment smooth_environment() {
  return {.name = "smooth", .gradient = {0.3, 0.4, 0.5}};
}

/// The same sky with a lamp at `theta` from the normal and `azimuth`, in degrees. It is 1.8 degrees
/// wide (at exp(-1/2) of its peak), and lights a white surface that faces it as much as the sky
/// does: 2 pi brightness / sharpness = pi. Throws std::invalid_argument for theta outside [0, 90]
/// or an azimuth that is not finite.
inline Environment lamp_environment(double theta = 30, double azimuth = 180) {
  if (!(theta >= 0 && theta <= 90) || !std::isfinite(azimuth))
    throw std::invalid_argument("lamp: theta must be in [0, 90] degrees and the azimuth finite");
  Environment light = smooth_environment();
  light.name = "lamp";
  light.lamp = {std::sin(theta * kDegree) * std::cos(azimuth * kDegree),
                std::sin(theta * kDegree) * std::sin(azimuth * kDegree), std::cos(theta * kDegree)};
  light.sharpness = 1000;
  light.brightness = 500;
  return light;
}

}  // namespace vndf::validate
