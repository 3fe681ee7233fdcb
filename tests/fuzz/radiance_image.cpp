// Bytes as an image of radiance in a file of EXR.
#include "vndf/io/radiance_image.h"

#include "fuzz/fuzz_target.h"
#include "fuzz/input_file.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const vndf::fuzz::InputFile file(vndf::fuzz::text_of(data, size));
  vndf::fuzz::accept_or_throw<vndf::io::RadianceImageError>([&] {
    const auto image = vndf::io::read_radiance_image(file.path());
    vndf::fuzz::require(image.values.size() == 3 * image.width * image.height,
                        "an image has another number of values than of its texels' colours");
  });
  return 0;
}
