// Maps in EXR files: which channels they have, and what those are.
#include <array>
#include <string>
#include <utility>

#include "vndf/io/exr_channels.h"
#include "vndf/io/map_pixels.h"

namespace vndf::io {
namespace {

constexpr char kAccepted[] =
    "give channels R, G, B or X, Y, Z (a normal map), X, Y or R, G (a normal map without z), or "
    "slope_x, slope_y or x, y (a slope map)";

using Kind = MapPixels::Kind;

constexpr std::array<Kind, 6> kKinds{
    Kind::normals, Kind::normals,           Kind::slopes,
    Kind::slopes,  Kind::normals_without_z, Kind::normals_without_z};

}  // namespace

MapPixels read_exr_map(const std::filesystem::path& path) {
  // Three names come before two of them. The kinds are above, in the same order.
  const std::array<ChannelNames, kKinds.size()> known{{{"R", "G", "B"},
                                                       {"X", "Y", "Z"},
                                                       {"slope_x", "slope_y"},
                                                       {"x", "y"},
                                                       {"X", "Y"},
                                                       {"R", "G"}}};
  ExrChannels image = read_exr_channels(path, known, kAccepted);
  return {.width = image.width,
          .height = image.height,
          .kind = kKinds[image.set],
          .format = "EXR",
          .values = std::move(image.values)};
}

}  // namespace vndf::io
