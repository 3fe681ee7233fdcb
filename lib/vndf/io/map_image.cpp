// Recognises the format of a map, and makes slopes of its pixels.
#include "vndf/io/map_image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <string_view>

#include "vndf/io/atomic_file.h"
#include "vndf/io/format_error.h"
#include "vndf/io/map_pixels.h"

namespace vndf::io {
namespace {

using namespace std::string_view_literals;

constexpr double kShortestNormal = 0.5, kLongestNormal = 1.5;

/// A format and the bytes with which its files begin.
struct Format {
  std::string_view beginning;
  MapPixels (*read)(const std::filesystem::path& path);
};

constexpr std::array<Format, 4> kFormats{{{"\x76\x2f\x31\x01"sv, read_exr_map},
                                          {"\x89PNG\r\n\x1a\n"sv, read_png_map},
                                          {"II*\0"sv, read_tiff_map},
                                          {"MM\0*"sv, read_tiff_map}}};

MapPixels read_pixels(const std::filesystem::path& path) {
  require_file(path);
  std::array<char, 8> head{};
  std::ifstream(path, std::ios::binary).read(head.data(), head.size());
  const std::string_view beginning(head.data(), head.size());
  for (const Format& format : kFormats)
    if (beginning.starts_with(format.beginning)) return format.read(path);
  throw FormatError("it is none of the images that are read", "give an EXR, PNG or TIFF file");
}

[[noreturn]] void refuse_texel(const MapPixels& pixels, std::size_t texel, const std::string& rule,
                               const std::string& remedy) {
  throw FormatError("the texel in column " + std::to_string(texel % pixels.width) + " of row " +
                        std::to_string(texel / pixels.width) + " " + rule,
                    remedy);
}

bool is_shifted(const MapPixels& pixels, NormalEncoding encoding) {
  if (pixels.kind == MapPixels::Kind::slopes) {
    if (encoding != NormalEncoding::automatic)
      throw FormatError("it holds slopes, which have no encoding", "leave the encoding out");
    return false;
  }
  if (pixels.whole_numbers) {
    if (encoding == NormalEncoding::plain)
      throw FormatError("it is a " + pixels.format + ", whose numbers cannot be negative",
                        "leave the encoding out, or take shifted");
    return true;
  }
  if (encoding != NormalEncoding::automatic) return encoding == NormalEncoding::shifted;
  return std::ranges::none_of(pixels.values, [](float v) { return v < 0; });
}

/// Slopes of the texels of one file.
class Slopes {
 public:
  Slopes(const MapPixels& pixels, NormalEncoding encoding)
      : pixels_(pixels), shifted_(is_shifted(pixels, encoding)) {}

  std::string content() const {
    if (pixels_.kind == MapPixels::Kind::slopes) return pixels_.format + ", slopes";
    return pixels_.format + (shifted_ ? ", normals n = 2 v - 1" : ", normals n = v");
  }

  Vec2<double> at(std::size_t texel) const {
    switch (pixels_.kind) {
      case MapPixels::Kind::slopes:
        return stored_slope(texel);
      case MapPixels::Kind::normals:
        return slope_of_normal(texel,
                               {component(texel, 0), component(texel, 1), component(texel, 2)});
      default:
        return slope_of_normal(texel, with_z(texel, component(texel, 0), component(texel, 1)));
    }
  }

 private:
  double value(std::size_t texel, std::size_t channel) const {
    return static_cast<double>(pixels_.values[texel * pixels_.channels() + channel]);
  }

  double component(std::size_t texel, std::size_t channel) const {
    const double v = value(texel, channel);
    return shifted_ ? 2 * v - 1 : v;
  }

  Vec2<double> stored_slope(std::size_t texel) const {
    const Vec2<double> slope{value(texel, 0), value(texel, 1)};
    if (!std::isfinite(slope.x) || !std::isfinite(slope.y))
      refuse_texel(pixels_, texel, "holds a slope that is not finite", "mend the map");
    return slope;
  }

  Vec3<double> with_z(std::size_t texel, double x, double y) const {
    const double square = 1 - x * x - y * y;
    if (!(square > 0))
      refuse_texel(pixels_, texel, "holds x and y of length " + std::to_string(std::hypot(x, y)),
                   "a unit normal has less; check that the encoding is right");
    return {x, y, std::sqrt(square)};
  }

  Vec2<double> slope_of_normal(std::size_t texel, const Vec3<double>& n) const {
    const double length = std::sqrt(dot(n, n));
    if (!(length >= kShortestNormal && length <= kLongestNormal))
      refuse_texel(pixels_, texel, "holds a normal of length " + std::to_string(length),
                   "normals need unit length; check that the encoding, [-1, 1] or [0, 1], is "
                   "right");
    if (!(n.z > 0))
      refuse_texel(pixels_, texel, "holds a normal with z = " + std::to_string(n.z),
                   "normals of a height field have z > 0; check that the encoding is right");
    return slope_of(n);
  }

  const MapPixels& pixels_;
  bool shifted_;
};

SlopeImage slopes_from(const MapPixels& pixels, NormalEncoding encoding) {
  const Slopes slopes(pixels, encoding);
  SlopeImage image{pixels.width, pixels.height, slopes.content(), {}};
  const std::size_t count = pixels.width * pixels.height;
  image.slopes.reserve(count);
  for (std::size_t texel = 0; texel < count; ++texel) image.slopes.push_back(slopes.at(texel));
  return image;
}

}  // namespace

SlopeImage slope_map_of(const MapPixels& pixels, const std::string& name,
                        NormalEncoding encoding) try {
  return slopes_from(pixels, encoding);
} catch (const FormatError& error) {
  throw MapImageError(name + ": " + error.what());
}

SlopeImage read_slope_map(const std::filesystem::path& path, NormalEncoding encoding) try {
  return slopes_from(read_pixels(path), encoding);
} catch (const FormatError& error) {
  throw MapImageError(path.string() + ": " + error.what());
}

}  // namespace vndf::io
