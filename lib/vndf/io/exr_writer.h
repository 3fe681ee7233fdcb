// Writes attributes and arrays as a multi-part EXR file in memory: one scan line part per array,
// named after it, and the attributes in the header of the first part.
#pragma once

#include <string>

#include "vndf/io/stored_tables.h"

namespace vndf::io {

/// Returns the bytes of the file. The same content gives the same bytes. Throws FormatError if
/// OpenEXR fails or an array has not two axes.
std::string write_exr(const StoredTables& stored);

}  // namespace vndf::io
