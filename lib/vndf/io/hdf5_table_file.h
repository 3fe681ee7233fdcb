// Attributes and arrays as an HDF5 file in memory: root attributes and root datasets.
#pragma once

#include <string>
#include <string_view>

#include "vndf/io/stored_tables.h"

namespace vndf::io {

/// The first bytes of an HDF5 file.
inline constexpr std::string_view kHdf5Magic = "\x89HDF\r\n\x1a\n";

/// Returns the bytes of the file. The same content gives the same bytes. Throws FormatError if HDF5
/// fails.
std::string write_hdf5(const StoredTables& stored);

/// Reads the bytes of write_hdf5, or of another program that follows tables/FORMAT.md. They must be
/// undamaged, because HDF5 may crash on damaged ones: see checksum_trailer.h. Throws FormatError if
/// HDF5 fails.
StoredTables read_hdf5(std::string_view bytes);

}  // namespace vndf::io
