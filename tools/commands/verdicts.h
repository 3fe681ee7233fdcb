// What the judging commands share: the law that a name or a table file stands for, and how verdicts
// are shown.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "commands/table_files.h"
#include "vndf/validate/validate.h"

namespace vndf::tools {

/// The distribution that tables were made from, by their recipe, which read a file of
/// `input_checksum` or none. Throws std::runtime_error where it cannot be had again.
std::unique_ptr<distributions::SlopeDistribution> distribution_of(
    const std::string& recipe, const std::string& input_checksum);
/// The same of a file of either kind.
std::unique_ptr<distributions::SlopeDistribution> distribution_of(const AnyTables& tables);

/// True if `argument` is the path of a file or looks like one.
bool names_a_file(const std::string& argument);

/// Where a finding is and what is to be said of it, in words.
std::string remark(const validate::Finding& finding);

/// A table, one line for each finding.
std::string describe(const validate::Verdict& verdict);

/// Place, tests and note are left out where they do not apply.
nlohmann::ordered_json to_json(const validate::Verdict& verdict);

/// A fresh seed from the machine, printed so that a run can be repeated.
std::uint64_t fresh_seed();

}  // namespace vndf::tools
