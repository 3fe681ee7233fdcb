// The pixels of named channels of an EXR file that anybody may have made, by OpenEXR. Maps of
// normals and images of radiance are read by it. Tables have a reader of their own
// (exr_reader.h), because their format is narrower.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace vndf::io {

struct ExrChannels {
  std::size_t width = 0, height = 0;
  /// Which of the sets was found.
  std::size_t set = 0;
  /// A value for each channel of the set, for each texel, row by row from the top.
  std::vector<float> values = {};
};

/// Names of channels that belong together.
using ChannelNames = std::vector<std::string>;

/// Reads the first of the `sets` that a part of the file has at full resolution: scan lines or
/// tiles, flat. Other channels are ignored. Throws FormatError with `accepted`, which says what to
/// give, where no part has any of them; where the file is missing, damaged or not EXR; and where it
/// is larger than check_map_size() and check_exr_headers() allow.
ExrChannels read_exr_channels(const std::filesystem::path& path, std::span<const ChannelNames> sets,
                              const std::string& accepted);

}  // namespace vndf::io
