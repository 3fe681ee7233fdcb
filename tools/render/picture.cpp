// Encodes images.
#include "render/picture.h"

#include <png.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "vndf/io/exr_image.h"
#include "vndf/io/format_error.h"
#include "vndf/io/picture_mark.h"

namespace vndf::render {
namespace {

/// From here on the largest channel is reduced, and so fast does it become pale (Khronos).
constexpr float kShoulder = 0.8f, kPaleness = 0.15f;

/// What is shown of a channel: no radiance where it is none. The most is finite, since infinity
/// over infinity is no colour.
float shown(float value) {
  return value > 0 ? std::min(value, std::numeric_limits<float>::max()) : 0;
}

/// Has slope 1 at the shoulder and tends to 1.
float reduced(float peak) {
  constexpr float d = 1 - kShoulder;
  return 1 - d * d / (peak - kShoulder + d);
}

std::uint8_t srgb_byte(float linear) {
  const float encoded =
      linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(encoded, 0.0f, 1.0f)));
}

std::vector<std::uint8_t> srgb_bytes(const Image& image, float exposure) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(3 * image.pixels.size());
  for (const Rgb& pixel : image.pixels) {
    const Rgb c = tone_mapped(exposure * pixel);
    bytes.insert(bytes.end(), {srgb_byte(c.r), srgb_byte(c.g), srgb_byte(c.b)});
  }
  return bytes;
}

}  // namespace

std::string exr_bytes(const Image& image, const std::map<std::string, std::string>& attributes) {
  io::ExrImage file{.width = image.width, .height = image.height, .attributes = attributes};
  file.attributes[std::string(io::kExrMarkName)] = io::kExrMarkValue;
  const auto add = [&](const char* name, float Rgb::*colour) {
    std::vector<float>& values = file.channels[name];
    for (const Rgb& pixel : image.pixels) values.push_back(pixel.*colour);
  };
  add("R", &Rgb::r);
  add("G", &Rgb::g);
  add("B", &Rgb::b);
  return io::write_exr_image(file);
}

Rgb tone_mapped(const Rgb& c) {
  const Rgb visible{shown(c.r), shown(c.g), shown(c.b)};
  const float peak = std::max({visible.r, visible.g, visible.b});
  if (peak <= kShoulder) return visible;
  const float top = reduced(peak);
  const float white = 1 - 1 / (kPaleness * (peak - top) + 1);
  const Rgb scaled = Rgb{visible.r / peak, visible.g / peak, visible.b / peak};
  return top * ((1 - white) * scaled + white * Rgb{1, 1, 1});
}

std::string png_bytes(const Image& image, float exposure) {
  const std::vector<std::uint8_t> pixels = srgb_bytes(image, exposure);
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.width);
  png.height = static_cast<png_uint_32>(image.height);
  png.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png);
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&png, bytes.data(), &size, 0, pixels.data(), 0, nullptr) == 0)
    throw io::FormatError(std::string("libpng cannot write it: ") + png.message,
                          "give the image a size");
  bytes.resize(size);
  return io::marked_png(bytes);
}

}  // namespace vndf::render
