// What the commands that validate share: the distribution that a table file stands for, and a seed.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "commands/table_files.h"
#include "vndf/distributions/slope_distribution.h"

namespace vndf::tools {

/// The distribution that tables were made from, by their recipe, which read a file of
/// `input_checksum` or none. Throws std::runtime_error where it cannot be had again.
std::unique_ptr<distributions::SlopeDistribution> distribution_of(
    const std::string& recipe, const std::string& input_checksum);
/// The same of a file of either kind.
std::unique_ptr<distributions::SlopeDistribution> distribution_of(const AnyTables& tables);

/// True if `argument` is the path of a file or looks like one.
bool names_a_file(const std::string& argument);

/// A fresh seed from the machine, printed so that a run can be repeated.
std::uint64_t fresh_seed();

}  // namespace vndf::tools
