// Words for people: numbers as they are typed, lists, and the known name that is nearest to an
// unknown one (Levenshtein distance), for the messages of specifications and formulas.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace vndf::support {

/// The shortest decimal text that reads back as exactly `value`.
std::string number_text(double value);

/// `value` to three significant digits, for messages.
std::string rounded_text(double value);

/// The start of `text` in single quotes, for messages: 60 bytes at most, and what is not printable
/// ASCII as '?', for a file may be of any bytes.
std::string quoted(std::string_view text);

/// "a, b, c".
std::string listed(const std::vector<std::string>& words);

/// "; did you mean 'ggx'?" for the known name that is nearest to `word` if one is near enough to be
/// meant, else "". Starts with ';' to follow a sentence.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& known);

}  // namespace vndf::support
