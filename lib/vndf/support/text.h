// Text for messages: numbers as they are typed, lists, and the known name that is nearest to an
// unknown one. A message that names what was meant saves the user a look into the documentation.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vndf::support {

/// The shortest decimal text that reads back as exactly `value`.
std::string number_text(double value);

/// Inverse of number_text(), whatever the locale: the number that all of `text` is. Returns nothing
/// if `text` is not a number, has something before or after it, or is not finite.
std::optional<double> finite_number(std::string_view text);

/// `value` to three significant digits.
std::string rounded_text(double value);

/// Up to 60 bytes of `text` in single quotes, the byte at `position` among them. "..." stands for
/// what is left out before and after. Bytes that are not printable ASCII become '?', because a file
/// may hold any bytes and a terminal may act on some.
std::string quoted(std::string_view text, std::size_t position = 0);

/// `text` as a terminal may show it on one line: control characters of ASCII and of C1, DEL and
/// bytes that are not UTF-8 become `\xNN`, and the line end `\n`. A result of more than `most`
/// bytes is cut there, and "..." follows. It is for names and messages that come from files and
/// arguments, because some of these bytes make a terminal act.
std::string printable(std::string_view text, std::size_t most = std::string_view::npos);

/// "a, b, c".
std::string listed(const std::vector<std::string>& items);

/// "; did you mean 'ggx'?" for the name in `known` that is nearest to `name`, or "" if none is
/// near. The distance is that of Levenshtein, a third of the length at most. It starts with ';' to
/// follow a sentence.
std::string did_you_mean(std::string_view name, const std::vector<std::string>& known);

}  // namespace vndf::support
