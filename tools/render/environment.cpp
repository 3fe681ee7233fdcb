// Looks directions up, and inverts the CDFs of rows and columns.
#include "render/environment.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <ranges>
#include <span>
#include <stdexcept>
#include <utility>

#include "render/sky.h"

namespace vndf::render {
namespace {

constexpr double kPi = std::numbers::pi;

void check(const Image& image) {
  const auto is_radiance = [](float v) { return v >= 0 && std::isfinite(v); };
  if (image.pixels.empty() || image.pixels.size() != image.width * image.height)
    throw std::invalid_argument("an environment needs an image; give it a size and its pixels");
  for (const Rgb& c : image.pixels)
    if (!is_radiance(c.r) || !is_radiance(c.g) || !is_radiance(c.b))
      throw std::invalid_argument(
          "an environment has a value that is negative or not finite; mend the image");
}

/// Where u falls: an interval between two sums, and the place in it.
struct Place {
  std::size_t index;
  double fraction;
};

/// Intervals without weight are never found, since the sum at the end of the one that is found is
/// greater than that at its beginning.
Place find(std::span<const double> sums, float u) {
  const double sum = static_cast<double>(u) * sums.back();
  const auto above = std::ranges::upper_bound(sums.first(sums.size() - 1), sum);
  const auto index = static_cast<std::size_t>(above - sums.begin());
  const double before = index > 0 ? sums[index - 1] : 0;
  return {index, (sum - before) / (sums[index] - before)};
}

std::size_t step_of(double share, std::size_t steps) {
  const auto step = static_cast<std::size_t>(share * static_cast<double>(steps));
  return std::min(step, steps - 1);
}

}  // namespace

Environment Environment::constant(const Rgb& radiance) {
  return Environment(Image{1, 1, {radiance}});
}

Environment Environment::sky() {
  return Environment(sky_image());
}

Environment::Environment(Image image) : image_(std::move(image)) {
  check(image_);
  black_ = std::ranges::all_of(image_.pixels, [](const Rgb& c) { return luminance(c) == 0; });
  for (std::size_t row = 0; row <= image_.height; ++row)
    edges_.push_back(std::cos(kPi * static_cast<double>(row) / static_cast<double>(image_.height)));
  columns_.reserve(image_.pixels.size());
  double all = 0;
  for (std::size_t row = 0; row < image_.height; ++row) {
    const double solid_angle =
        2 * kPi * (edges_[row] - edges_[row + 1]) / static_cast<double>(image_.width);
    double sum = 0;
    for (std::size_t column = 0; column < image_.width; ++column)
      columns_.push_back(sum +=
                         solid_angle *
                         (black_ ? 1.0 : static_cast<double>(luminance(image_.at(column, row)))));
    rows_.push_back(all += sum);
  }
}

std::size_t Environment::texel_of(const Vector& w) const {
  const double x = static_cast<double>(w.x), y = static_cast<double>(w.y);
  const double angle = std::atan2(std::hypot(x, y), static_cast<double>(w.z));
  const double right = std::atan2(x, y);  // from the y axis, from -pi to pi
  return step_of(angle / kPi, image_.height) * image_.width +
         step_of(0.5 + right / (2 * kPi), image_.width);
}

Environment::Sample Environment::sample_of(const Vector& w, std::size_t texel) const {
  const Rgb& radiance = image_.pixels[texel];
  const double weight = black_ ? 1.0 : static_cast<double>(luminance(radiance));
  return {w, radiance, static_cast<float>(weight / rows_.back())};
}

Environment::Sample Environment::toward(const Vector& w) const {
  return sample_of(w, texel_of(w));
}

Environment::Sample Environment::sample(float u1, float u2) const {
  const Place row = find(rows_, u1);
  const std::size_t first = row.index * image_.width;
  const Place column = find(std::span(columns_).subspan(first, image_.width), u2);
  const double z = std::lerp(edges_[row.index], edges_[row.index + 1], row.fraction);
  const double right =
      2 * kPi *
      ((static_cast<double>(column.index) + column.fraction) / static_cast<double>(image_.width) -
       0.5);
  const double sine = std::sqrt((1 - z) * (1 + z));
  return sample_of({static_cast<float>(sine * std::sin(right)),
                    static_cast<float>(sine * std::cos(right)), static_cast<float>(z)},
                   first + column.index);
}

}  // namespace vndf::render
