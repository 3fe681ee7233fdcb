// How the program shows a verdict: as text for people, as JSON for programs.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "vndf/validate/validate.h"

namespace vndf::tools {

/// Where a finding is and what is to be said of it, in words.
std::string remark(const validate::Finding& finding);

/// A table, one line for each finding.
std::string describe(const validate::Verdict& verdict);

/// Place, tests and note are left out where they do not apply.
nlohmann::ordered_json to_json(const validate::Verdict& verdict);

}  // namespace vndf::tools
