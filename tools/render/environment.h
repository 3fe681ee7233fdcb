// Light from far away as a function of direction: an image in latitude and longitude, of which each
// texel has one radiance. Nothing is interpolated, so the density with which directions are sampled
// is exactly in proportion to their luminance.
#pragma once

#include <cstddef>
#include <vector>

#include "render/image.h"

namespace vndf::render {

class Environment {
 public:
  /// The same radiance from everywhere, each channel finite and >= 0.
  static Environment constant(const Rgb& radiance);
  /// The picture of sky.h.
  static Environment sky();

  /// The rows of `image` go from the zenith (z = 1) down to the nadir, in steps of equal angle. Its
  /// columns go around as one sees them from inside: the middle is the y axis, the x axis is a
  /// quarter to the right. This is the latitude-longitude map of OpenEXR, with its up axis turned
  /// to z. Throws std::invalid_argument if the image is empty, or has a value that is not finite or
  /// is negative.
  explicit Environment(Image image);

  struct Sample {
    Vector w;
    Rgb radiance;
    float pdf;  ///< per solid angle
  };
  /// Draws a direction in proportion to luminance, or evenly if all is black. u1 and u2 are in
  /// [0, 1).
  Sample sample(float u1, float u2) const;
  /// What sample() gives where it draws the unit direction `w`: its density is luminance over the
  /// integral of it. Maximum error of the density relative to the exact one: 1e-6.
  Sample toward(const Vector& w) const;
  /// The radiance from there, and the density alone.
  Rgb radiance(const Vector& w) const { return toward(w).radiance; }
  float pdf(const Vector& w) const { return toward(w).pdf; }

 private:
  std::size_t texel_of(const Vector& w) const;
  Sample sample_of(const Vector& w, std::size_t texel) const;

  Image image_;
  /// The heights z at which rows begin and end.
  std::vector<double> edges_;
  /// Sums of what is sampled: over the rows up to each, and in each row over the texels up to each.
  /// The last of all is the integral over directions.
  std::vector<double> rows_, columns_;
  bool black_ = false;
};

}  // namespace vndf::render
