// Writing and checking the checksum trailer.
#include "vndf/io/checksum_trailer.h"

#include <utility>

#include "vndf/io/crc64.h"
#include "vndf/io/format_error.h"
#include "vndf/io/table_format.h"

namespace vndf::io {
namespace {

std::string trailer_of(std::string_view content) {
  Crc64 crc;
  crc.add(content);
  return std::string(kTrailerText) + hex_digits(crc.value());
}

/// Both formats store texts uncompressed. The file type can therefore be found without parsing, and
/// it tells a damaged table file from a file of another program.
FormatError no_trailer_error(std::string_view bytes) {
  if (bytes.find(kFileType) != std::string_view::npos)
    return {
        "its last bytes are not the checksum trailer of a table file, so it was cut short or "
        "changed",
        "copy it again, or build it again"};
  return {"it holds no vndf slope tables: another program wrote it, or it was cut short",
          "give a file written by vndf"};
}

}  // namespace

std::string with_trailer(std::string content) {
  const std::string trailer = trailer_of(content);
  return std::move(content) + trailer;
}

std::string_view without_trailer(std::string_view bytes) {
  if (bytes.size() < kTrailerBytes) throw no_trailer_error(bytes);
  const std::string_view content = bytes.substr(0, bytes.size() - kTrailerBytes);
  const std::string_view trailer = bytes.substr(content.size());
  if (!trailer.starts_with(kTrailerText)) throw no_trailer_error(bytes);
  if (trailer != trailer_of(content))
    throw FormatError("it is damaged: its bytes do not match the checksum at its end",
                      "copy it again, or build it again");
  return content;
}

}  // namespace vndf::io
