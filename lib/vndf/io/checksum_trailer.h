// The checksum trailer: the last 32 bytes of every table file hold a checksum of all bytes before
// them. It shows that a file is as it was written and was not cut short or changed by accident. It
// does not show who wrote it: anybody can compute it for a forged file, so the readers trust
// nothing in a file because its trailer is right (untrusted_file.h).
//
// Both formats allow bytes after their end, so other programs read a file with a trailer as usual.
#pragma once

#include <string>
#include <string_view>

namespace vndf::io {

/// The trailer is this text and 16 lower-case hexadecimal digits, the CRC-64/XZ.
inline constexpr std::string_view kTrailerText = "vndf crc-64/xz: ";
inline constexpr std::size_t kTrailerBytes = kTrailerText.size() + 16;

/// Returns `content` followed by its trailer.
std::string with_trailer(std::string content);

/// Returns the bytes before the trailer. Throws FormatError if the trailer is missing or does not
/// match them, because the bytes were cut short, changed, or written by another program.
std::string_view without_trailer(std::string_view bytes);

}  // namespace vndf::io
