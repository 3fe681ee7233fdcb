// Maps in EXR files, by OpenEXR.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfPartType.h>

#include <algorithm>
#include <array>
#include <exception>
#include <fstream>
#include <string>

#include "vndf/io/exr_map_header.h"
#include "vndf/io/format_error.h"
#include "vndf/io/map_pixels.h"

namespace vndf::io {
namespace {

constexpr int kNoThreads = 0;
// Pixels are read and kept in blocks of rows, so a short file that claims to be large is found out
// before much memory is taken.
constexpr int kRowsPerBlock = 64;
// Headers are short but for previews, which are small pictures.
constexpr std::size_t kLongestHead = std::size_t{4} << 20;
constexpr char kAccepted[] =
    "give channels R, G, B or X, Y, Z (a normal map), X, Y or R, G (a normal map without z), or "
    "slope_x, slope_y or x, y (a slope map)";

using Kind = MapPixels::Kind;

struct ChannelSet {
  std::vector<std::string> names;
  Kind kind;
};

/// Three names come before two of them.
const std::array<ChannelSet, 6> kKnownChannels{{{{"R", "G", "B"}, Kind::normals},
                                                {{"X", "Y", "Z"}, Kind::normals},
                                                {{"slope_x", "slope_y"}, Kind::slopes},
                                                {{"x", "y"}, Kind::slopes},
                                                {{"X", "Y"}, Kind::normals_without_z},
                                                {{"R", "G"}, Kind::normals_without_z}}};

void check_headers(const std::filesystem::path& path, std::uint64_t file_bytes) {
  std::ifstream stream(path, std::ios::binary);
  std::string head(std::min<std::uint64_t>(file_bytes, kLongestHead), '\0');
  if (!stream.read(head.data(), static_cast<std::streamsize>(head.size())))
    throw FormatError("it cannot be read", "check its permissions");
  check_exr_headers(head, file_bytes);
}

/// The first known set of channels that the part has at full resolution, or none.
const ChannelSet* known_channels(const Imf::Header& header) {
  const bool flat =
      !header.hasType() || header.type() == Imf::SCANLINEIMAGE || header.type() == Imf::TILEDIMAGE;
  const auto has = [&](const std::string& name) {
    const Imf::Channel* channel = header.channels().findChannel(name);
    return channel != nullptr && channel->xSampling == 1 && channel->ySampling == 1;
  };
  for (const ChannelSet& set : kKnownChannels)
    if (flat && std::ranges::all_of(set.names, has)) return &set;
  return nullptr;
}

/// Names come from the file, so that only their printable characters are listed.
std::string listed_channels(const Imf::MultiPartInputFile& file) {
  constexpr std::size_t kLongestList = 200;
  std::string list;
  for (int part = 0; part < file.parts() && list.size() < kLongestList; ++part) {
    const Imf::ChannelList& channels = file.header(part).channels();
    for (auto c = channels.begin(); c != channels.end() && list.size() < kLongestList; ++c)
      list += std::string(list.empty() ? "" : ", ") + c.name();
  }
  std::ranges::replace_if(
      list, [](char c) { return c < ' ' || c > '~'; }, '?');
  return list;
}

/// Reads the rows from `first` to `last`, both included, to the end of `pixels`.
void read_rows(Imf::InputPart& part, const std::vector<std::string>& names, int first, int last,
               MapPixels& pixels) {
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

MapPixels read_part(Imf::MultiPartInputFile& file, int index, const ChannelSet& set,
                    std::uint64_t file_bytes) {
  Imf::InputPart part(file, index);
  const Imath::Box2i window = part.header().dataWindow();
  const auto side = [](int low, int high) { return std::int64_t{high} - low + 1; };
  const std::int64_t width = side(window.min.x, window.max.x);
  const std::int64_t height = side(window.min.y, window.max.y);
  check_map_size(width, height, file_bytes);
  if (!file.partComplete(index)) throw FormatError("it ends too early", "copy it again");
  MapPixels pixels{.width = static_cast<std::size_t>(width),
                   .height = static_cast<std::size_t>(height),
                   .kind = set.kind,
                   .format = "EXR"};
  for (int row = window.min.y; row <= window.max.y; row += kRowsPerBlock)
    read_rows(part, set.names, row, std::min(row + kRowsPerBlock - 1, window.max.y), pixels);
  return pixels;
}

}  // namespace

MapPixels read_exr_map(const std::filesystem::path& path) try {
  const std::uint64_t file_bytes = std::filesystem::file_size(path);
  check_headers(path, file_bytes);
  Imf::MultiPartInputFile file(path.c_str(), kNoThreads, false);
  for (int part = 0; part < file.parts(); ++part)
    if (const ChannelSet* set = known_channels(file.header(part)))
      return read_part(file, part, *set, file_bytes);
  throw FormatError("its channels are " + listed_channels(file), kAccepted);
} catch (const FormatError&) {
  throw;
} catch (const std::exception&) {
  throw FormatError("OpenEXR cannot read it", "copy it again, or write it with another program");
}

}  // namespace vndf::io
