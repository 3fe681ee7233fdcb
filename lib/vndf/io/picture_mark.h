// What vndf leaves in the pictures that it draws and renders, so that it knows later that it may
// replace them. Programs that show pictures pass over it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "vndf/io/format_error.h"

namespace vndf::io {

/// A comment at the end of an SVG file.
inline constexpr std::string_view kSvgMark = "<!-- Drawn by vndf -->\n";
/// A chunk tEXt of a PNG file with its length and CRC (PNG specification, 11.3.4).
inline constexpr std::string_view kPngMark{"\0\0\0\x0dtEXtSoftware\0vndf\x93\xf2\xd4\x2f", 25};
/// An attribute of an EXR file. It has this name because attributes are in the order of the
/// alphabet, where capitals are first: however long the others are, it is at the beginning.
inline constexpr std::string_view kExrMarkName = "Software";
inline constexpr std::string_view kExrMarkValue = "vndf";
/// The bytes of this attribute.
inline constexpr std::string_view kExrMark{"Software\0string\0\4\0\0\0vndf", 24};

/// The bytes of a PNG file with the mark. Throws FormatError if they are none.
inline std::string marked_png(const std::string& bytes) {
  constexpr std::size_t kLastChunk = 12;  // IEND
  if (bytes.size() <= kLastChunk || !bytes.starts_with("\x89PNG"))
    throw FormatError("the picture is no PNG file", "draw it again");
  return std::string(bytes).insert(bytes.size() - kLastChunk, kPngMark);
}

}  // namespace vndf::io
