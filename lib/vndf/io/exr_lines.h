// The scan lines of an EXR part, which are deflated by 16 ("ZIP").
#pragma once

#include <string>

#include "vndf/io/exr_header.h"

namespace vndf::io {

/// The bytes of all lines of a part, `line_bytes` each, from the top: all values of the first
/// channel, then those of the next. Throws FormatError where a chunk is missing, of another part
/// or of other lines, or its bytes are damaged or too many. Allocates `lines` * `line_bytes` and
/// what three chunks take.
std::string exr_lines(UntrustedFile& file, const ExrPart& part, std::uint32_t part_number,
                      std::size_t lines, std::size_t line_bytes);

}  // namespace vndf::io
