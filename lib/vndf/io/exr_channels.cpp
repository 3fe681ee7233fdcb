// Reads channels by OpenEXR, which opens the file once its headers are known to be harmless.
#include "vndf/io/exr_channels.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfPartType.h>

#include <algorithm>
#include <exception>
#include <fstream>
#include <optional>

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

void check_headers(const std::filesystem::path& path, std::uint64_t file_bytes) {
  std::ifstream stream(path, std::ios::binary);
  std::string head(std::min<std::uint64_t>(file_bytes, kLongestHead), '\0');
  if (!stream.read(head.data(), static_cast<std::streamsize>(head.size())))
    throw FormatError("it cannot be read", "check its permissions");
  check_exr_headers(head, file_bytes);
}

/// The first of the sets that the part has at full resolution, or none.
std::optional<std::size_t> find_set(const Imf::Header& header, std::span<const ChannelNames> sets) {
  const bool flat =
      !header.hasType() || header.type() == Imf::SCANLINEIMAGE || header.type() == Imf::TILEDIMAGE;
  const auto has = [&](const std::string& name) {
    const Imf::Channel* channel = header.channels().findChannel(name);
    return channel != nullptr && channel->xSampling == 1 && channel->ySampling == 1;
  };
  for (std::size_t k = 0; k < sets.size(); ++k)
    if (flat && std::ranges::all_of(sets[k], has)) return k;
  return {};
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

/// Reads the rows from `first` to `last`, both included, to the end of `image`.
void read_rows(Imf::InputPart& part, const ChannelNames& names, int first, int last,
               ExrChannels& image) {
  const std::size_t old = image.values.size();
  const Imath::V2i origin(part.header().dataWindow().min.x, first);
  const int rows = last - first + 1;
  image.values.resize(old + image.width * static_cast<std::size_t>(rows) * names.size());
  Imf::FrameBuffer frame;
  const std::size_t texel = sizeof(float) * names.size();
  for (std::size_t c = 0; c < names.size(); ++c)
    frame.insert(names[c], Imf::Slice::Make(Imf::FLOAT, image.values.data() + old + c, origin,
                                            static_cast<std::int64_t>(image.width), rows, texel,
                                            texel * image.width));
  part.setFrameBuffer(frame);
  part.readPixels(first, last);
}

ExrChannels read_part(Imf::MultiPartInputFile& file, int index, const ChannelNames& names,
                      std::uint64_t file_bytes) {
  Imf::InputPart part(file, index);
  const Imath::Box2i window = part.header().dataWindow();
  const auto side = [](int low, int high) { return std::int64_t{high} - low + 1; };
  const std::int64_t width = side(window.min.x, window.max.x);
  const std::int64_t height = side(window.min.y, window.max.y);
  check_map_size(width, height, file_bytes);
  if (!file.partComplete(index)) throw FormatError("it ends too early", "copy it again");
  ExrChannels image{.width = static_cast<std::size_t>(width),
                    .height = static_cast<std::size_t>(height)};
  for (int row = window.min.y; row <= window.max.y; row += kRowsPerBlock)
    read_rows(part, names, row, std::min(row + kRowsPerBlock - 1, window.max.y), image);
  return image;
}

}  // namespace

ExrChannels read_exr_channels(const std::filesystem::path& path, std::span<const ChannelNames> sets,
                              const std::string& accepted) try {
  const std::uint64_t file_bytes = std::filesystem::file_size(path);
  check_headers(path, file_bytes);
  Imf::MultiPartInputFile file(path.c_str(), kNoThreads, false);
  for (int part = 0; part < file.parts(); ++part)
    if (const auto set = find_set(file.header(part), sets)) {
      ExrChannels image = read_part(file, part, sets[*set], file_bytes);
      image.set = *set;
      return image;
    }
  throw FormatError("its channels are " + listed_channels(file), accepted);
} catch (const FormatError&) {
  throw;
} catch (const std::exception&) {
  throw FormatError("OpenEXR cannot read it", "copy it again, or write it with another program");
}

}  // namespace vndf::io
