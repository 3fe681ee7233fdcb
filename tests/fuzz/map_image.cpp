// Bytes as a map in a file of EXR, PNG or TIFF.
#include "vndf/io/map_image.h"

#include "fuzz/fuzz_target.h"
#include "fuzz/input_file.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const vndf::fuzz::InputFile file(vndf::fuzz::text_of(data, size));
  vndf::fuzz::accept_or_throw<vndf::io::MapImageError>([&] {
    const auto image = vndf::io::read_slope_map(file.path());
    vndf::fuzz::require(image.slopes.size() == image.width * image.height,
                        "a map has another number of slopes than of texels");
  });
  return 0;
}
