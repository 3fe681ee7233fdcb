// One number for all that sampling depends on: the same for the same tables in either file format,
// whoever made them and however their certificate was measured.
#pragma once

#include <cstdint>

#include "vndf/slope_tables.h"

namespace vndf::io {

/// CRC-64/XZ over the byte sequence that tables/FORMAT.md defines: the name of the
/// coordinates, the numbers, tables and curves. Not over the distribution's name.
std::uint64_t content_checksum(const SlopeTables& tables);

}  // namespace vndf::io
