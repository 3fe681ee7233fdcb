// How far an image is from a reference of the same scene.
#include "render/image_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

namespace vndf::render {
namespace {

using Colours = std::array<double, 3>;

Colours colours(const Rgb& c) {
  return {c.r, c.g, c.b};
}

double square(double x) {
  return x * x;
}

void require_finite(const Image& image, const std::string& which) {
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    for (const double value : colours(image.pixels[i]))
      if (!std::isfinite(value))
        throw std::invalid_argument(which + " is not finite at pixel (" +
                                    std::to_string(i % image.width) + ", " +
                                    std::to_string(i / image.width) + ")");
}

void require_same_size(const Image& a, const Image& b) {
  if (a.width != b.width || a.height != b.height || a.pixels.size() != b.pixels.size())
    throw std::invalid_argument("images of different sizes cannot be compared");
}

/// The eps of a reference.
double floor_of(const Image& reference) {
  require_finite(reference, "the reference");
  const double mean = mean_luminance(reference);  // not a number if there is no pixel
  if (!(mean > 0)) throw std::invalid_argument("the reference is black, so nothing compares to it");
  return square(kDarkness * mean);
}

/// The mean over the colours of a pixel.
double relative_square(const Rgb& pixel, const Rgb& other, const Rgb& reference, double eps) {
  const Colours a = colours(pixel), b = colours(other), r = colours(reference);
  double sum = 0;
  for (std::size_t c = 0; c < 3; ++c) sum += square(a[c] - b[c]) / (square(r[c]) + eps);
  return sum / 3;
}

struct Mean {
  double value, standard_error;
};

/// The mean of relative_square() over pixels.
Mean relative_mse(const Image& image, const Image& other, const Image& reference, double eps) {
  const auto count = static_cast<double>(image.pixels.size());
  double sum = 0, squares = 0;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const double error =
        relative_square(image.pixels[i], other.pixels[i], reference.pixels[i], eps);
    sum += error;
    squares += square(error);
  }
  const double mean = sum / count, variance = squares / count - square(mean);
  return {mean, std::sqrt(std::max(variance, 0.0) / count)};
}

}  // namespace

double mean_luminance(const Image& image) {
  double sum = 0;
  for (const Rgb& pixel : image.pixels) sum += luminance(pixel);
  return sum / static_cast<double>(image.pixels.size());
}

ImageError image_error(const Image& image, const Image& reference) {
  require_same_size(image, reference);
  require_finite(image, "the image");
  const double eps = floor_of(reference);
  const Mean mse = relative_mse(image, reference, reference, eps);
  ImageError error{.relative_mse = mse.value, .standard_error = mse.standard_error};
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const double there = luminance(reference.pixels[i]);
    const double ratio = luminance(image.pixels[i]) / std::sqrt(square(there) + eps);
    if (ratio > kFirefly) ++error.fireflies;
    if (ratio <= error.brightest) continue;
    error.brightest = ratio;
    error.x = i % image.width;
    error.y = i / image.width;
  }
  error.firefly_share =
      static_cast<double>(error.fireflies) / static_cast<double>(image.pixels.size());
  return error;
}

Image mean_of(const Image& a, const Image& b) {
  require_same_size(a, b);
  Image mean = a;
  for (std::size_t i = 0; i < mean.pixels.size(); ++i)
    mean.pixels[i] = 0.5f * (a.pixels[i] + b.pixels[i]);
  return mean;
}

double error_of_mean(const Image& a, const Image& b) {
  const Image mean = mean_of(a, b);
  return relative_mse(a, b, mean, floor_of(mean)).value / 4;
}

}  // namespace vndf::render
