// How the program shows a verdict of the validator: as text for people, as JSON for programs.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "vndf/validate/validate.h"

namespace vndf::tools {

/// Where a result is and what is to be said of it, in words.
std::string remark(const validate::CheckResult& result);

/// A table, one line for each result.
std::string describe(const validate::Verdict& verdict);

/// Place, tests and note are left out where they do not apply.
nlohmann::ordered_json to_json(const validate::Verdict& verdict);

}  // namespace vndf::tools
