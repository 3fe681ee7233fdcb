// Images of radiance in EXR files, which a renderer takes for light from far away.
#pragma once

#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <vector>

namespace vndf::io {

struct RadianceImage {
  std::size_t width = 0, height = 0;
  /// Linear red, green and blue for each texel, row by row from the top. All are finite and >= 0,
  /// and some are > 0.
  std::vector<float> values = {};
};

/// The error of a file that cannot be read as radiance. The message names the file, the rule that
/// it breaks, and what to do.
class RadianceImageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads the channels R, G and B of an EXR file, or Y as grey, as read_exr_channels() does. Throws
/// RadianceImageError where the file cannot be read, where a value is negative or not finite,
/// naming column and row, and where all of it is black.
RadianceImage read_radiance_image(const std::filesystem::path& path);

}  // namespace vndf::io
