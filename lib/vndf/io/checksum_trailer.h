// The last 32 bytes of every table file: a check of all bytes before them, so that neither HDF5 nor
// OpenEXR, which trust much of what they read, is ever given bytes other than those written.
// Both formats allow bytes after their end, so other programs read a sealed file as usual.
#pragma once

#include <string>
#include <string_view>

namespace vndf::io {

/// "vndf crc-64/xz: " and 16 lower-case hexadecimal digits.
inline constexpr std::string_view kSealText = "vndf crc-64/xz: ";
inline constexpr std::size_t kSealBytes = kSealText.size() + 16;

/// `content` with its seal after it.
std::string sealed(std::string content);

/// The content of sealed bytes. Throws Refusal if the seal is missing or does not match: the bytes
/// were cut short, changed, or written by another program.
std::string_view unsealed(std::string_view bytes);

}  // namespace vndf::io
