// Reads table files in the EXR format. Such files come from strangers, and OpenEXR is not made for
// that: 3.1.5 allocates what a header declares before it has seen the pixels, and one of 3000
// mutants of a small file took 0.9 GB and 3 s. This reads the part of EXR that tables/FORMAT.md
// describes, and nothing else.
#pragma once

#include <string_view>

#include "vndf/io/stored_tables.h"

namespace vndf::io {

/// The first bytes of an EXR file.
inline constexpr std::string_view kExrMagic = "\x76\x2f\x31\x01";

/// Reads the attributes and arrays that the format names, of the bytes of write_exr() or of another
/// program that follows tables/FORMAT.md. Any bytes are safe: UntrustedFile bounds what is read and
/// allocated. Throws FormatError for the first rule that is broken; the identity of the file is
/// checked before its arrays are looked at.
StoredTables read_exr(std::string_view bytes);

}  // namespace vndf::io
