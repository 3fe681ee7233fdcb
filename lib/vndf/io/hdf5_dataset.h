// The values of an HDF5 dataset in chunks.
#pragma once

#include "vndf/io/hdf5_object.h"
#include "vndf/io/stored_tables.h"

namespace vndf::io {

/// The shape and the values of a dataset; without values where they are neither float32 nor float64
/// or may_read() the shape says no. Throws FormatError where they are not in chunks inside the file
/// ("contiguous", "compact", "virtual" or elsewhere), where a chunk is missing or there twice, and
/// where UntrustedFile does.
Array hdf5_array(UntrustedFile& file, const Hdf5Object& dataset);

}  // namespace vndf::io
