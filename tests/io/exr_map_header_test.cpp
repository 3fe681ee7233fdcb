// Headers of EXR maps in which OpenEXR would read on beyond an attribute, and allocate what it
// finds there.
#include "vndf/io/exr_map_header.h"

#include <cstdint>
#include <string>

#include "support/catch.h"
#include "vndf/io/format_error.h"

namespace {

using vndf::io::check_exr_headers;
using vndf::io::FormatError;

std::string number(std::uint32_t n) {
  std::string bytes;
  for (int k = 0; k < 4; ++k) bytes += static_cast<char>(n >> (8 * k));
  return bytes;
}

std::string attribute(const std::string& type, const std::string& value) {
  return std::string("a\0", 2) + type + std::string(1, '\0') +
         number(static_cast<std::uint32_t>(value.size())) + value;
}

/// Whether a file of one header with one attribute may be opened.
bool accepted(const std::string& type, const std::string& value) {
  const std::string head =
      "\x76\x2f\x31\x01" + number(2) + attribute(type, value) + std::string(1, '\0');
  try {
    check_exr_headers(head, head.size());
    return true;
  } catch (const FormatError&) {
    return false;
  }
}

const std::string kEnd(1, '\0');
const std::string kChannel = std::string("R\0", 2) + std::string(16, '\1');

}  // namespace

TEST_CASE("values of the size that their type has are accepted") {
  CHECK(accepted("box2i", std::string(16, '\0')));
  CHECK(accepted("chlist", kChannel + kEnd));
  CHECK(accepted("preview", number(1) + number(2) + std::string(8, '\0')));
  CHECK(accepted("stringvector", number(2) + "ab" + number(0)));
  CHECK(accepted("a type of somebody", "anything"));
}

TEST_CASE("values of another size than their type has are refused") {
  CHECK_FALSE(accepted("box2i", std::string(17, '\0')));
  CHECK_FALSE(accepted("float", std::string(3, '\0')));
  CHECK_FALSE(accepted("chlist", kChannel + kEnd + number(1)));
  CHECK_FALSE(accepted("chlist", kChannel));
}

TEST_CASE("values that declare more than they have are refused") {
  CHECK_FALSE(accepted("preview", number(1) + number(3) + std::string(8, '\0')));
  CHECK_FALSE(accepted("preview", number(1u << 31) + number(1u << 31)));
  CHECK_FALSE(accepted("stringvector", number(1u << 30) + "ab"));
}
