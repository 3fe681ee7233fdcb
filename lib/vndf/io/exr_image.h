// Images of named floating-point channels as EXR files, for data that a person will look at.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace vndf::io {

struct ExrImage {
  std::size_t width = 0, height = 0;
  /// Values row by row from the top, width * height of each. "a.b" is channel b of layer a.
  std::map<std::string, std::vector<float>> channels = {};
  /// What the image shows, for its header.
  std::map<std::string, std::string> attributes = {};
};

/// The bytes of a scan line file of 32-bit floats; the same image gives the same bytes. Throws
/// FormatError if a channel has not width * height values, there is none, or OpenEXR fails.
std::string write_exr_image(const ExrImage& image);

}  // namespace vndf::io
