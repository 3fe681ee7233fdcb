// One number for all that sampling and validation depend on: the tables and the specification of
// their distribution. It is the same in either file format, whichever program wrote the file and
// however the certificate was measured.
#pragma once

#include <cstdint>

#include "vndf/provenance.h"
#include "vndf/slope_tables.h"

namespace vndf::io {

/// Returns the CRC-64/XZ of the byte sequence that tables/FORMAT.md defines: the name of the
/// coordinates, the numbers, tables and curves, and the specification with its samples. The texts
/// for people do not count.
std::uint64_t content_checksum(const SlopeTables& tables, const Specification& specification);

}  // namespace vndf::io
