// Tables built once and shared by the tests.
#pragma once

#include <string>

#include "vndf/precompute/build_tables.h"

namespace vndf::test {

/// Tables of 1024 x 1024, as they are shipped, of a distribution by its specification.
const precompute::BuiltTables& large_tables(const std::string& distribution);

/// The same of 64 x 96.
const precompute::BuiltTables& small_tables(const std::string& distribution);

}  // namespace vndf::test
