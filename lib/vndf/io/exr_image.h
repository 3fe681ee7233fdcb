// Images of named floating-point channels as EXR files. The pictures of a report are rounded to
// colours; these files hold their data.
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

/// Returns the bytes of a scan line file of 32-bit floats. The same image gives the same bytes.
/// Throws FormatError if there is no channel, if one has not width * height values, or if OpenEXR
/// fails.
std::string write_exr_image(const ExrImage& image);

}  // namespace vndf::io
