// How the program shows a verdict: as text for people, as JSON for programs.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "vndf/validate/validate.h"

namespace vndf::tools {

/// Where a result was measured, and its note.
std::string remark(const validate::CheckResult& result);

/// One line for each result, and one for what was not run and why, under the name of the sampler and its verdict.
std::string describe(const validate::Verdict& verdict);

/// The same as one object. Place, tests and note are left out where they do not apply.
nlohmann::ordered_json to_json(const validate::Verdict& verdict);

/// Whether records are accepted, or else the worst failure with its place, and the others.
std::string conclusion(const validate::Verdict& verdict);

/// What counted samples can show, as part of a sentence that has no full stop.
std::string resolution_text(const validate::Resolution& resolution);

}  // namespace vndf::tools
