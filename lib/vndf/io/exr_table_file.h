// Attributes and arrays as a multi-part EXR file in memory: one scan line part per array, named
// after it, and the attributes in the header of the first part.
#pragma once

#include <string>
#include <string_view>

#include "vndf/io/stored_tables.h"

namespace vndf::io {

/// The first bytes of an EXR file.
inline constexpr std::string_view kExrMagic = "\x76\x2f\x31\x01";

/// Returns the bytes of the file. The same content gives the same bytes. Throws FormatError if
/// OpenEXR fails or an array has not two axes.
std::string write_exr(const StoredTables& stored);

/// Reads the bytes of write_exr, or of another program that follows tables/FORMAT.md. They must be
/// undamaged, because OpenEXR may crash on damaged ones: see checksum_trailer.h. Throws FormatError
/// if OpenEXR fails.
StoredTables read_exr(std::string_view bytes);

}  // namespace vndf::io
