// The headers of a multi-part EXR file as attributes, and where its chunks are. Names and numbers
// are those of "OpenEXR File Layout" (the OpenEXR project).
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "vndf/io/untrusted_file.h"

namespace vndf::io {

struct ExrAttribute {
  std::string_view type, value;
};

/// One part: its attributes and its table of places of chunks, eight bytes each.
struct ExrPart {
  std::map<std::string, ExrAttribute> attributes;
  std::string_view chunks;
};

/// The parts of a file, with those of their attributes that have one of `names` or that the
/// functions below need. Throws FormatError unless it is of EXR version 2 and of several parts.
std::vector<ExrPart> exr_parts(UntrustedFile& file, const std::vector<std::string>& names);

/// The name of a part, empty where it has none.
std::string exr_name(const ExrPart& part);

/// Rows and columns of a part whose pixels start at (0, 0); nothing of any other.
std::vector<std::size_t> exr_shape(const ExrPart& part);

/// What the channels of a part are: all of its values in `Y` as float, in `high` and `low` as
/// uint, or another thing.
enum class ExrPixels { other, float32, float64 };
ExrPixels exr_pixels(const ExrPart& part);

/// Whether the part is of scan lines, and whether it is compressed in the way of table files.
bool has_scan_lines(const ExrPart& part);
bool is_zip(const ExrPart& part);

}  // namespace vndf::io
