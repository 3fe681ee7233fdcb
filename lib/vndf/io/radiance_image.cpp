// Reads radiance, and refuses values that are none.
#include "vndf/io/radiance_image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <string>
#include <string_view>
#include <utility>

#include "vndf/io/atomic_file.h"
#include "vndf/io/exr_channels.h"
#include "vndf/io/exr_reader.h"
#include "vndf/io/format_error.h"

namespace vndf::io {
namespace {

constexpr std::size_t kColours = 3;

/// OpenEXR says of a text only that it cannot read it.
void require_exr(const std::filesystem::path& path) {
  require_file(path);
  std::array<char, kExrMagic.size()> head{};
  std::ifstream(path, std::ios::binary).read(head.data(), head.size());
  if (std::string_view(head.data(), head.size()) != kExrMagic)
    throw FormatError("it is not an EXR file", "give one, or convert it");
}

std::vector<float> with_colours(const std::vector<float>& grey) {
  std::vector<float> values;
  values.reserve(kColours * grey.size());
  for (const float value : grey) values.insert(values.end(), kColours, value);
  return values;
}

void check_values(const RadianceImage& image) {
  const auto is_radiance = [](float v) { return v >= 0 && std::isfinite(v); };
  const auto wrong = std::ranges::find_if_not(image.values, is_radiance);
  if (wrong != image.values.end()) {
    const auto texel = static_cast<std::size_t>(wrong - image.values.begin()) / kColours;
    throw FormatError("the texel in column " + std::to_string(texel % image.width) + " of row " +
                          std::to_string(texel / image.width) + " holds " +
                          (*wrong < 0 ? "a negative value" : "a value that is not finite"),
                      "radiance is finite and not negative, so mend the image");
  }
  if (std::ranges::none_of(image.values, [](float v) { return v > 0; }))
    throw FormatError("it is black everywhere", "give an image with light in it");
}

}  // namespace

RadianceImage read_radiance_image(const std::filesystem::path& path) try {
  require_exr(path);
  const std::array<ChannelNames, 2> known{{{"R", "G", "B"}, {"Y"}}};
  ExrChannels channels =
      read_exr_channels(path, known, "give the channels R, G and B of linear colour, or Y of grey");
  const bool grey = channels.set == 1;
  RadianceImage image{channels.width, channels.height,
                      grey ? with_colours(channels.values) : std::move(channels.values)};
  check_values(image);
  return image;
} catch (const FormatError& error) {
  throw RadianceImageError(path.string() + ": " + error.what());
}

}  // namespace vndf::io
