// Bytes as a map in a file of EXR, PNG or TIFF. The libraries that decode them read files.
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "fuzz/fuzz_target.h"
#include "vndf/io/map_image.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto path = std::filesystem::temp_directory_path() /
                    std::string("vndf-fuzz-map-").append(std::to_string(getpid()));
  std::ofstream(path, std::ios::binary) << vndf::fuzz::text_of(data, size);
  vndf::fuzz::accept_or_throw<vndf::io::MapImageError>([&] {
    const auto image = vndf::io::read_slope_map(path);
    vndf::fuzz::require(image.slopes.size() == image.width * image.height,
                        "a map has another number of slopes than of texels");
  });
  std::filesystem::remove(path);
  return 0;
}
