// Tables built once and shared by the tests.
#pragma once

#include <string>

#include "precompute/build_tables.h"

namespace vndf::test {

/// The shipped tables, 1024 x 1024, of "ggx" or "beckmann".
const precompute::BuiltTables& large_tables(const std::string& distribution);

/// 64 x 96 tables of the same.
const precompute::BuiltTables& small_tables(const std::string& distribution);

}  // namespace vndf::test
