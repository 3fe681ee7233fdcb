// How far an image is from a reference of the same scene, in numbers that do not depend on how
// bright the scene is.
//
// Both numbers divide by sqrt(R^2 + eps), where R is the reference of a pixel. A division by R
// alone would let the few darkest pixels decide. eps is the square of a share of the mean luminance
// of the reference, so that a scene with twice the light has the same errors.
#pragma once

#include <cstddef>

#include "render/image.h"

namespace vndf::render {

/// eps = (kDarkness * mean luminance of the reference)^2: darker pixels are judged like one of this
/// share of the mean. A tenth is where noise in a picture begins to be seen as such.
inline constexpr double kDarkness = 0.1;

/// A pixel is a firefly if its luminance is beyond this many times the reference.
inline constexpr double kFirefly = 10;

/// The mean luminance of all pixels; not a number if there is none.
double mean_luminance(const Image& image);

struct ImageError {
  /// Mean of (I - R)^2 / (R^2 + eps) over all pixels and colours.
  double relative_mse = 0;
  /// The standard error of that mean, from how it differs between pixels. If few pixels make most
  /// of the error, as fireflies do, this is large, and two images cannot be ranked by the mean.
  double standard_error = 0;
  /// Number of pixels whose luminance I is beyond kFirefly * sqrt(R^2 + eps), and their share.
  std::size_t fireflies = 0;
  double firefly_share = 0;
  /// The largest I / sqrt(R^2 + eps) of a luminance, and the pixel that has it.
  double brightest = 0;
  std::size_t x = 0, y = 0;
};

/// Compares `image` with `reference`. Throws std::invalid_argument if their sizes differ, if there
/// is no pixel, if a value is not finite (naming the pixel), or if the reference is not brighter
/// than black.
ImageError image_error(const Image& image, const Image& reference);

/// The mean of two images of the same size.
Image mean_of(const Image& a, const Image& b);

/// The relative MSE that mean_of(a, b) itself has if the errors of `a` and `b` are independent and
/// equally distributed: a quarter of that of their difference. Below it, a relative MSE that was
/// measured with that mean as the reference says nothing. Throws as image_error() does.
double error_of_mean(const Image& a, const Image& b);

}  // namespace vndf::render
