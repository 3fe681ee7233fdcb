// Inflates what a file holds deflated. Both formats of files use the zlib format (RFC 1950).
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace vndf::io {

/// Returns what the zlib stream `deflated` unpacks to. Throws FormatError if it is damaged or would
/// be more than `most` bytes, which are all that is allocated.
std::string inflate(std::string_view deflated, std::size_t most);

}  // namespace vndf::io
