// Errors of images that are made by hand, so that every number is known.
#include "render/image_error.h"

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "support/catch.h"

using namespace vndf::render;
using vndf::test::Approx;
using vndf::test::contains;

namespace {

/// A relative error that no rounding of pixels to floats reaches.
constexpr double kRounding = 1e-6;

Image grey_image(std::size_t width, std::size_t height, float grey) {
  return {width, height, std::vector<Rgb>(width * height, Rgb{grey, grey, grey})};
}

std::string message_of(const Image& image, const Image& reference) {
  try {
    image_error(image, reference);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace

TEST_CASE("an image is its own reference without error") {
  const Image image = grey_image(3, 2, 0.7f);
  const ImageError error = image_error(image, image);
  CHECK(error.relative_mse == 0);
  CHECK(error.fireflies == 0);
  CHECK(error.firefly_share == 0);
  CHECK(error.brightest == Approx(1 / std::sqrt(1.01)).epsilon(kRounding));
}

TEST_CASE("the relative mean squared error is the mean over pixels and colours") {
  const Image reference = grey_image(2, 2, 1);
  Image image = reference;
  image.pixels[3].g = 4;  // one of twelve values, wrong by 3 where R^2 + eps = 1.01
  CHECK(image_error(image, reference).relative_mse == Approx(9 / 1.01 / 12).epsilon(kRounding));
}

TEST_CASE("the standard error tells how much of the error is that of few pixels") {
  const Image reference = grey_image(10, 10, 1);
  Image one = reference, all = reference;
  one.pixels[7] = {11, 11, 11};
  for (Rgb& pixel : all.pixels) pixel = {2, 2, 2};
  const ImageError few = image_error(one, reference), many = image_error(all, reference);
  CHECK(few.relative_mse == Approx(many.relative_mse).epsilon(kRounding));
  CHECK(many.standard_error == Approx(0).margin(kRounding));
  // One of n values is not 0: the standard error is sqrt(1 - 1/n) of the mean.
  CHECK(few.standard_error == Approx(std::sqrt(0.99) * few.relative_mse).epsilon(kRounding));
}

TEST_CASE("errors do not depend on how bright the scene is") {
  Image reference = grey_image(2, 2, 1), image = reference;
  reference.pixels[1] = {0.01f, 0.02f, 0};
  image.pixels[2] = {30, 20, 10};
  const ImageError before = image_error(image, reference);
  for (Image* scaled : {&reference, &image})
    for (Rgb& pixel : scaled->pixels) pixel = 1024 * pixel;  // a power of 2 rounds nothing
  const ImageError after = image_error(image, reference);
  CHECK(after.relative_mse == before.relative_mse);
  CHECK(after.brightest == before.brightest);
  CHECK(after.fireflies == before.fireflies);
}

TEST_CASE("a black pixel of the reference is judged like one of a tenth of the mean") {
  Image reference = grey_image(10, 1, 1);
  reference.pixels[4] = {};  // the mean is 0.9, and eps 0.09^2
  Image image = reference;
  image.pixels[4] = {0.09f, 0.09f, 0.09f};
  const ImageError error = image_error(image, reference);
  CHECK(error.relative_mse == Approx(1.0 / 10).epsilon(kRounding));
  CHECK(error.fireflies == 0);
}

TEST_CASE("fireflies are the pixels beyond ten times the reference, and the brightest is found") {
  const Image reference = grey_image(5, 4, 2);
  Image image = reference;
  image.pixels[5 * 1 + 2] = {19, 19, 19};     // 9.5 times
  image.pixels[5 * 2 + 4] = {21, 21, 21};     // 10.5 times, 10.4 with eps
  image.pixels[5 * 3 + 1] = {100, 100, 100};  // 50 times
  image.pixels[0] = {};                       // darkness is none
  const ImageError error = image_error(image, reference);
  CHECK(error.fireflies == 2);
  CHECK(error.firefly_share == 2.0 / 20);
  CHECK(error.x == 1);
  CHECK(error.y == 3);
  CHECK(error.brightest == Approx(50 / std::sqrt(1.01)).epsilon(kRounding));
}

TEST_CASE("images that cannot be compared are refused with the reason") {
  const Image reference = grey_image(2, 3, 1);
  CHECK_THAT(message_of(grey_image(3, 2, 1), reference), contains("different sizes"));
  CHECK_THAT(message_of({}, {}), contains("the reference is black"));
  CHECK_THAT(message_of(reference, grey_image(2, 3, 0)), contains("the reference is black"));
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), HUGE_VALF, -HUGE_VALF}) {
    Image image = reference;
    image.pixels[5].b = bad;
    CHECK(message_of(image, reference) == "the image is not finite at pixel (1, 2)");
    CHECK(message_of(reference, image) == "the reference is not finite at pixel (1, 2)");
    CHECK_THROWS_AS(error_of_mean(image, reference), std::invalid_argument);
  }
  CHECK_THROWS_AS(mean_of(reference, grey_image(1, 1, 1)), std::invalid_argument);
}

TEST_CASE("the error of a mean of two noisy images is what a noiseless reference finds") {
  constexpr std::size_t kSide = 128;
  const Image truth = grey_image(kSide, kSide, 1);
  std::mt19937 random(1);
  std::normal_distribution<float> noise(1, 0.1f);
  Image halves[2] = {truth, truth};
  for (Image& half : halves)
    for (Rgb& pixel : half.pixels) pixel = {noise(random), noise(random), noise(random)};
  const double estimated = error_of_mean(halves[0], halves[1]);
  const double found = image_error(mean_of(halves[0], halves[1]), truth).relative_mse;
  // Either is a mean of n = 3 * 128^2 independent squares of normal variables, whose relative
  // spread is sqrt(2 / n) = 0.0064. The sum and the difference of two such are independent, so that
  // their ratio spreads by 0.009, and 4.5 of that are 0.04. The denominator R^2 + eps of the
  // estimate varies with noise of 0.07, which adds about 3 * 0.07^2 = 0.015.
  CHECK(estimated / found == Approx(1.0).margin(0.06));
}
