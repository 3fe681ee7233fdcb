// Normal maps and slope maps in EXR files, read as slopes.
#include "vndf/io/map_image.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfPartType.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <exception>
#include <string>

#include "vndf/io/atomic_file.h"
#include "vndf/io/format_error.h"

namespace vndf::io {
namespace {

constexpr int kNoThreads = 0;
// Pixels are read and kept in blocks of rows, so a short file that claims to be large is found out
// before much memory is taken.
constexpr int kRowsPerBlock = 64;
constexpr double kShortestNormal = 0.5, kLongestNormal = 1.5;
constexpr char kAccepted[] =
    "give an EXR file with the channels R, G, B or X, Y, Z (a normal map), or slope_x, slope_y or "
    "x, y (a slope map)";

using ChannelNames = std::vector<std::string>;

const std::array<ChannelNames, 4> kKnownChannels{
    {{"R", "G", "B"}, {"X", "Y", "Z"}, {"slope_x", "slope_y"}, {"x", "y"}}};

/// The pixels of some channels, one after the other for each texel.
struct Pixels {
  std::size_t width, height, channels;
  std::vector<float> values;

  double at(std::size_t texel, std::size_t channel) const {
    return static_cast<double>(values[texel * channels + channel]);
  }
};

[[noreturn]] void refuse_texel(const Pixels& pixels, std::size_t texel, const std::string& rule,
                               const std::string& remedy) {
  throw FormatError("the texel in column " + std::to_string(texel % pixels.width) + " of row " +
                        std::to_string(texel / pixels.width) + " " + rule,
                    remedy);
}

// Finding and reading the pixels.

/// Those of the known names that the part has at full resolution; none if it has no such set.
ChannelNames known_channels(const Imf::Header& header) {
  const bool flat =
      !header.hasType() || header.type() == Imf::SCANLINEIMAGE || header.type() == Imf::TILEDIMAGE;
  const auto has = [&](const std::string& name) {
    const Imf::Channel* channel = header.channels().findChannel(name);
    return channel != nullptr && channel->xSampling == 1 && channel->ySampling == 1;
  };
  for (const ChannelNames& names : kKnownChannels)
    if (flat && std::all_of(names.begin(), names.end(), has)) return names;
  return {};
}

std::string listed_channels(const Imf::MultiPartInputFile& file) {
  constexpr std::size_t kLongestList = 200;
  std::string list;
  for (int part = 0; part < file.parts() && list.size() < kLongestList; ++part) {
    const Imf::ChannelList& channels = file.header(part).channels();
    for (auto c = channels.begin(); c != channels.end() && list.size() < kLongestList; ++c)
      list += std::string(list.empty() ? "" : ", ") + c.name();
  }
  return list;
}

void check_size(const Imath::Box2i& window) {
  const auto side = [](int low, int high) { return std::int64_t{high} - low + 1; };
  const std::int64_t width = side(window.min.x, window.max.x);
  const std::int64_t height = side(window.min.y, window.max.y);
  constexpr auto kMost = static_cast<std::int64_t>(kMaxMapSide);
  if (width < 1 || height < 1 || width > kMost || height > kMost)
    throw FormatError(
        "it has " + std::to_string(width) + " x " + std::to_string(height) + " texels",
        "give a map of at most " + std::to_string(kMost) + " x " + std::to_string(kMost) +
            " texels");
}

/// Reads the rows from `first` to `last`, both included, to the end of `pixels`.
void read_rows(Imf::InputPart& part, const ChannelNames& names, int first, int last,
               Pixels& pixels) {
  const std::size_t old = pixels.values.size();
  const Imath::V2i origin(part.header().dataWindow().min.x, first);
  const int rows = last - first + 1;
  pixels.values.resize(old + pixels.width * static_cast<std::size_t>(rows) * names.size());
  Imf::FrameBuffer frame;
  const std::size_t texel = sizeof(float) * names.size();
  for (std::size_t c = 0; c < names.size(); ++c)
    frame.insert(names[c], Imf::Slice::Make(Imf::FLOAT, pixels.values.data() + old + c, origin,
                                            static_cast<std::int64_t>(pixels.width), rows, texel,
                                            texel * pixels.width));
  part.setFrameBuffer(frame);
  part.readPixels(first, last);
}

Pixels read_part(Imf::MultiPartInputFile& file, int index, const ChannelNames& names) {
  Imf::InputPart part(file, index);
  const Imath::Box2i window = part.header().dataWindow();
  check_size(window);
  if (!file.partComplete(index)) throw FormatError("it ends too early", "copy it again");
  Pixels pixels{static_cast<std::size_t>(window.max.x - window.min.x) + 1,
                static_cast<std::size_t>(window.max.y - window.min.y) + 1,
                names.size(),
                {}};
  for (int row = window.min.y; row <= window.max.y; row += kRowsPerBlock)
    read_rows(part, names, row, std::min(row + kRowsPerBlock - 1, window.max.y), pixels);
  return pixels;
}

Pixels read_pixels(const std::filesystem::path& path) {
  require_file(path);
  Imf::MultiPartInputFile file(path.c_str(), kNoThreads, false);
  for (int part = 0; part < file.parts(); ++part)
    if (const auto names = known_channels(file.header(part)); !names.empty())
      return read_part(file, part, names);
  throw FormatError("its channels are " + listed_channels(file), kAccepted);
}

// Making slopes of them.

bool is_shifted(const Pixels& pixels, NormalEncoding encoding) {
  if (encoding != NormalEncoding::automatic) return encoding == NormalEncoding::shifted;
  return std::none_of(pixels.values.begin(), pixels.values.end(), [](float v) { return v < 0; });
}

Vec2<double> slope_of_normal(const Pixels& pixels, std::size_t texel, bool shifted) {
  const auto component = [&](std::size_t channel) {
    const double v = pixels.at(texel, channel);
    return shifted ? 2 * v - 1 : v;
  };
  const Vec3<double> n{component(0), component(1), component(2)};
  const double length = std::sqrt(dot(n, n));
  if (!(length >= kShortestNormal && length <= kLongestNormal))
    refuse_texel(pixels, texel, "holds a normal of length " + std::to_string(length),
                 "normals need unit length; check that the encoding, [-1, 1] or [0, 1], is right");
  if (!(n.z > 0))
    refuse_texel(pixels, texel, "holds a normal with z = " + std::to_string(n.z),
                 "normals of a height field have z > 0; check that the encoding is right");
  return slope_of(n);
}

Vec2<double> slope_as_stored(const Pixels& pixels, std::size_t texel) {
  const Vec2<double> slope{pixels.at(texel, 0), pixels.at(texel, 1)};
  if (!std::isfinite(slope.x) || !std::isfinite(slope.y))
    refuse_texel(pixels, texel, "holds a slope that is not finite", "mend the map");
  return slope;
}

SlopeImage slopes_from(const Pixels& pixels, NormalEncoding encoding) {
  SlopeImage image{pixels.width, pixels.height, {}};
  const std::size_t count = pixels.width * pixels.height;
  image.slopes.reserve(count);
  const bool normals = pixels.channels == 3;
  const bool shifted = normals && is_shifted(pixels, encoding);
  for (std::size_t texel = 0; texel < count; ++texel)
    image.slopes.push_back(normals ? slope_of_normal(pixels, texel, shifted)
                                   : slope_as_stored(pixels, texel));
  return image;
}

}  // namespace

SlopeImage read_slope_map(const std::filesystem::path& path, NormalEncoding encoding) try {
  return slopes_from(read_pixels(path), encoding);
} catch (const FormatError& error) {
  throw MapImageError(path.string() + ": " + error.what());
} catch (const std::exception& error) {
  throw MapImageError(path.string() + ": OpenEXR cannot read it: " + error.what() + "; " +
                      kAccepted);
}

}  // namespace vndf::io
