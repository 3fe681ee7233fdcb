// Sealing and judging whole files.
#include "vndf/io/checksum_trailer.h"

#include <utility>

#include "vndf/io/crc64.h"
#include "vndf/io/format_error.h"
#include "vndf/io/table_format.h"

namespace vndf::io {
namespace {

std::string seal_of(std::string_view content) {
  Crc64 crc;
  crc.add(content);
  return std::string(kSealText) + hex_digits(crc.value());
}

/// Both formats hold texts as they are, so the file type can be found without parsing anything.
Refusal unsealed_refusal(std::string_view bytes) {
  if (bytes.find(kFileType) != std::string_view::npos)
    return {"its last bytes are not the seal of a table file, so it was cut short or changed",
            "copy it again, or make it again with its recipe"};
  return {"it holds no vndf slope tables: another program wrote it, or it was cut short",
          "give a file written by vndf"};
}

}  // namespace

std::string sealed(std::string content) {
  const std::string seal = seal_of(content);
  return std::move(content) + seal;
}

std::string_view unsealed(std::string_view bytes) {
  if (bytes.size() < kSealBytes) throw unsealed_refusal(bytes);
  const std::string_view content = bytes.substr(0, bytes.size() - kSealBytes);
  const std::string_view seal = bytes.substr(content.size());
  if (!seal.starts_with(kSealText)) throw unsealed_refusal(bytes);
  if (seal != seal_of(content))
    throw Refusal("it is damaged: its bytes do not match the seal at its end",
                  "copy it again, or make it again with its recipe");
  return content;
}

}  // namespace vndf::io
