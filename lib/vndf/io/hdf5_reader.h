// Reads table files in the HDF5 format. Such files come from strangers, and libhdf5 is not made for
// that: 79 of 3000 mutants of a small file crash 1.10.8, and a whole file can make it open other
// files, load code and take any amount of memory. This reads the part of HDF5 that tables/FORMAT.md
// describes, which is all that libhdf5 writes into a table file, and nothing else.
#pragma once

#include <string_view>

#include "vndf/io/stored_tables.h"

namespace vndf::io {

/// The first bytes of an HDF5 file.
inline constexpr std::string_view kHdf5Magic = "\x89HDF\r\n\x1a\n";

/// Reads the attributes and arrays that the format names, of the bytes of write_hdf5() or of
/// another program that follows tables/FORMAT.md. Any bytes are safe: UntrustedFile bounds what is
/// read and allocated. Throws FormatError for the first rule that is broken; the identity of the
/// file is checked before its arrays are looked at.
StoredTables read_hdf5(std::string_view bytes);

}  // namespace vndf::io
