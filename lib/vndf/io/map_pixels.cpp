// The size of a map.
#include "vndf/io/map_pixels.h"

#include "vndf/io/format_error.h"

namespace vndf::io {

void check_map_size(std::int64_t width, std::int64_t height, std::uint64_t file_bytes) {
  constexpr auto kMost = static_cast<std::int64_t>(kMaxMapSide);
  const std::string has =
      "it has " + std::to_string(width) + " x " + std::to_string(height) + " texels";
  if (width < 1 || height < 1 || width > kMost || height > kMost)
    throw FormatError(has, "give a map of at most " + std::to_string(kMost) + " x " +
                               std::to_string(kMost) + " texels");
  if (static_cast<std::uint64_t>(width * height) > most_texels(file_bytes))
    throw FormatError(
        has + ", which is more than a file of " + std::to_string(file_bytes) + " bytes can hold",
        "copy it again, or give a smaller one");
}

}  // namespace vndf::io
