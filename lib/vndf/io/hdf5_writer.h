// Writes attributes and arrays as an HDF5 file in memory: root attributes and root datasets.
#pragma once

#include <string>

#include "vndf/io/stored_tables.h"

namespace vndf::io {

/// Returns the bytes of the file. The same content gives the same bytes. Throws FormatError if HDF5
/// fails.
std::string write_hdf5(const StoredTables& stored);

}  // namespace vndf::io
