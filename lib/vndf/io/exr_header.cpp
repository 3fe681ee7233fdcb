// Reading EXR headers and the tables of places that follow them.
#include "vndf/io/exr_header.h"

#include <algorithm>
#include <iterator>

namespace vndf::io {
namespace {

using namespace std::string_view_literals;

constexpr std::uint32_t kVersion = 2, kLongNames = 0x400, kManyParts = 0x1000;
constexpr char kName[] = "name", kType[] = "type", kChannels[] = "channels",
               kCompression[] = "compression", kWindow[] = "dataWindow",
               kChunkCount[] = "chunkCount";

/// The channels of tables: names, pixel types (2 is float, 0 is uint), and no subsampling.
constexpr std::string_view kFloat = "Y\0\x02\0\0\0\0\0\0\0\x01\0\0\0\x01\0\0\0\0"sv;
constexpr std::string_view kWords =
    "high\0\0\0\0\0\0\0\0\0\x01\0\0\0\x01\0\0\0"
    "low\0\0\0\0\0\0\0\0\0\x01\0\0\0\x01\0\0\0\0"sv;

void check_version(ByteCursor& cursor) {
  cursor.take(4);  // the magic number, by which the format was recognised
  const auto version = cursor.number<std::uint32_t>();
  if ((version & ~kLongNames) != (kVersion | kManyParts))
    throw broken_file(
        "it is not an EXR file of several scan line parts, so another program wrote it");
}

bool is_wanted(std::string_view name, const std::vector<std::string>& names) {
  constexpr std::string_view kOwn[] = {kName, kType, kChannels, kCompression, kWindow, kChunkCount};
  return std::ranges::find(kOwn, name) != std::end(kOwn) ||
         std::ranges::find(names, name) != names.end();
}

/// One header; no attributes at all end the list of headers.
ExrPart next_part(ByteCursor& cursor, const std::vector<std::string>& names, bool& is_last) {
  ExrPart part;
  is_last = true;
  for (std::string_view name = cursor.text(); !name.empty(); name = cursor.text()) {
    is_last = false;
    const std::string_view type = cursor.text();
    const ExrAttribute attribute{type, cursor.take(cursor.number<std::uint32_t>())};
    if (is_wanted(name, names) && !part.attributes.emplace(name, attribute).second)
      throw broken_file("the attribute '" + std::string(name) + "' is there twice");
  }
  return part;
}

/// The value of an attribute, which must have that type.
std::string_view value_of(const ExrPart& part, const char* name, std::string_view type) {
  const auto found = part.attributes.find(name);
  if (found == part.attributes.end() || found->second.type != type)
    throw broken_file(std::string("a part of the EXR file has no attribute '") + name + "'");
  return found->second.value;
}

}  // namespace

std::vector<ExrPart> exr_parts(UntrustedFile& file, const std::vector<std::string>& names) {
  ByteCursor cursor(file.from(0));
  check_version(cursor);
  std::vector<ExrPart> parts;
  for (bool is_last = false; !is_last;) {
    ExrPart part = next_part(cursor, names, is_last);
    if (!is_last) parts.push_back(std::move(part));
  }
  for (ExrPart& part : parts) {
    ByteCursor count(value_of(part, kChunkCount, "int"));
    part.chunks = cursor.take(std::uint64_t{8} * count.number<std::uint32_t>());
  }
  file.read(file.size() - cursor.left());
  return parts;
}

std::string exr_name(const ExrPart& part) {
  return part.attributes.contains(kName) ? std::string(value_of(part, kName, "string")) : "";
}

std::vector<std::size_t> exr_shape(const ExrPart& part) {
  ByteCursor window(value_of(part, kWindow, "box2i"));
  const auto left = window.number<std::int32_t>(), top = window.number<std::int32_t>();
  const auto right = window.number<std::int32_t>(), bottom = window.number<std::int32_t>();
  if (left != 0 || top != 0 || right < 0 || bottom < 0) return {};
  return {static_cast<std::size_t>(bottom) + 1, static_cast<std::size_t>(right) + 1};
}

ExrPixels exr_pixels(const ExrPart& part) {
  const std::string_view channels = value_of(part, kChannels, "chlist");
  if (channels == kFloat) return ExrPixels::float32;
  return channels == kWords ? ExrPixels::float64 : ExrPixels::other;
}

bool has_scan_lines(const ExrPart& part) {
  return value_of(part, kType, "string") == "scanlineimage";
}

bool is_zip(const ExrPart& part) {
  return value_of(part, kCompression, "compression") == "\x03";
}

}  // namespace vndf::io
