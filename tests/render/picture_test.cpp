// Images as files: what programs read back, and what people see.
#include "render/picture.h"

#include <png.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfStringAttribute.h>

#include "support/catch.h"
#include "support/exr_memory_input.h"
#include "vndf/io/format_error.h"
#include "vndf/io/picture_mark.h"

using namespace vndf;
using namespace vndf::render;
using namespace vndf::test;

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

Image row_of(const std::vector<Rgb>& pixels) {
  return {pixels.size(), 1, pixels};
}

/// The bytes of the pixels of a PNG file, by libpng.
std::vector<std::uint8_t> pixels_of(const std::string& bytes) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  REQUIRE(png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()) != 0);
  CHECK(png.format == PNG_FORMAT_RGB);
  std::vector<std::uint8_t> pixels(PNG_IMAGE_SIZE(png));
  REQUIRE(png_image_finish_read(&png, nullptr, pixels.data(), 0, nullptr) != 0);
  return pixels;
}

bool is_shown(const Rgb& c) {
  const auto inside = [](float v) { return v >= 0 && v <= 1; };
  return inside(c.r) && inside(c.g) && inside(c.b);
}

}  // namespace

TEST_CASE("a picture has the bytes of sRGB") {
  // 0.0031308 is where the line and the power meet. The bytes are 255 times 12.92 v or
  // 1.055 v^(1/2.4) - 0.055, computed by another program in double precision.
  const Image image = row_of({{0, 0.0015f, 0.0031308f}, {0.01f, 0.18f, 0.22f}, {0.5f, 0.7f, 0.8f}});
  CHECK(pixels_of(png_bytes(image, 1)) ==
        std::vector<std::uint8_t>{0, 5, 10, 25, 118, 129, 188, 218, 231});
}

TEST_CASE("pixels of a picture are in rows from the top") {
  const Image image{2, 2, {{0, 0, 0}, {0.8f, 0, 0}, {0, 0.8f, 0}, {0, 0, 0.8f}}};
  CHECK(pixels_of(png_bytes(image, 1)) ==
        std::vector<std::uint8_t>{0, 0, 0, 231, 0, 0, 0, 231, 0, 0, 0, 231});
}

TEST_CASE("the exposure is a factor of radiance") {
  CHECK(pixels_of(png_bytes(row_of({{0.1f, 0.2f, 0.3f}}), 2)) ==
        pixels_of(png_bytes(row_of({{0.2f, 0.4f, 0.6f}}), 1)));
}

TEST_CASE("greys up to the shoulder are left as they are, and brighter ones stay greys") {
  for (const float grey : {0.0f, 0.1f, 0.5f, 0.8f})
    CHECK(tone_mapped({grey, grey, grey}).g == grey);
  float before = 0.8f;
  for (const float grey : {0.81f, 0.9f, 1.0f, 2.0f, 10.0f, 100.0f}) {
    const Rgb c = tone_mapped({grey, grey, grey});
    CHECK(c.r == c.g);
    CHECK(c.g == c.b);
    CHECK(c.g > before);
    CHECK(c.g < 1);
    before = c.g;
  }
}

TEST_CASE("the curve of tones has no corner at the shoulder") {
  // The curvature 2 / 0.2 times half the step of 1e-3, and rounding.
  constexpr float kStep = 1e-3f;
  const float slope = (tone_mapped({0.8f + kStep, 0, 0}).r - 0.8f) / kStep;
  CHECK(slope == Approx(1).margin(0.006));
}

TEST_CASE("a bright colour keeps the order of its channels and becomes pale") {
  float before = 0;
  for (const float brightness : {1.0f, 4.0f, 40.0f, 1e4f}) {
    const Rgb c = tone_mapped({brightness, brightness / 2, brightness / 10});
    CHECK(is_shown(c));
    CHECK(c.r >= c.g);
    CHECK(c.g >= c.b);
    CHECK(c.b / c.r > before);
    before = c.b / c.r;
  }
}

TEST_CASE("what is not radiance is shown as black or white") {
  const auto shows = [](const Rgb& c, const Rgb& as) {
    const Rgb t = tone_mapped(c);
    CHECK(is_shown(t));
    CHECK((t.r == as.r && t.g == as.g && t.b == as.b));
  };
  shows({kNaN, kNaN, kNaN}, {0, 0, 0});
  shows({-1, -kInfinity, 0.5f}, {0, 0, 0.5f});
  shows({kNaN, 0.5f, 0.25f}, {0, 0.5f, 0.25f});
  shows({kInfinity, kInfinity, kInfinity}, {1, 1, 1});
  shows({kInfinity, 0, 0}, {1, 1, 1});
  shows({std::numeric_limits<float>::max(), 1, 1}, {1, 1, 1});
}

TEST_CASE("radiance reads back from EXR as it is, with what is said about it") {
  const Image image{2, 1, {{1e-30f, 0.5f, -1}, {1e30f, 3, kInfinity}}};
  const std::string bytes = exr_bytes(image, {{"scene", "plate"}});
  CHECK(exr_bytes(image, {{"scene", "plate"}}) == bytes);
  ExrMemoryInput stream(bytes);
  Imf::InputFile file(stream, 0);
  CHECK(file.header().typedAttribute<Imf::StringAttribute>("scene").value() == "plate");
  std::vector<Rgb> read(2);
  Imf::FrameBuffer frame;
  const auto insert = [&](const char* name, float& first) {
    frame.insert(name, Imf::Slice::Make(Imf::FLOAT, &first, {0, 0}, 2, 1, sizeof(Rgb)));
  };
  insert("R", read[0].r);
  insert("G", read[0].g);
  insert("B", read[0].b);
  file.setFrameBuffer(frame);
  file.readPixels(0);
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(read[i].r == image.pixels[i].r);
    CHECK(read[i].g == image.pixels[i].g);
    CHECK(read[i].b == image.pixels[i].b);
  }
}

TEST_CASE("both files bear the mark of vndf, however much is said in them") {
  CHECK_THAT(png_bytes(row_of({{1, 1, 1}}), 1), contains(std::string(io::kPngMark)));
  const std::string exr = exr_bytes(row_of({{1, 1, 1}}), {{"scene", std::string(10000, 'a')}});
  CHECK(exr.find(io::kExrMark) < 1000);
}

TEST_CASE("an empty image is no picture") {
  CHECK_THROWS_AS(png_bytes({}, 1), io::FormatError);
  CHECK_THROWS_AS(exr_bytes({}, {}), io::FormatError);
}
