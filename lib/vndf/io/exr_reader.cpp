// From EXR parts to arrays. EXR has no float64 pixels: float64 arrays are two channels of 32-bit
// words.
#include "vndf/io/exr_reader.h"

#include <algorithm>
#include <bit>
#include <cstdint>

#include "vndf/io/exr_lines.h"

namespace vndf::io {
namespace {

Attribute value_of(const ExrAttribute& attribute) {
  ByteCursor value(attribute.value);
  if (attribute.type == "int") return int{value.number<std::int32_t>()};
  if (attribute.type == "double") return value.number<double>();
  if (attribute.type == "string" && attribute.value.size() <= kMaxTextBytes)
    return std::string(attribute.value);
  return NotUsed{};
}

/// Each line has the high words of its values and then the low ones.
std::vector<double> doubles_of(const std::string& bytes, std::size_t columns) {
  std::vector<double> values;
  values.reserve(bytes.size() / sizeof(double));
  for (ByteCursor cursor(bytes); cursor.left() > 0;) {
    ByteCursor high(cursor.take(4 * columns)), low(cursor.take(4 * columns));
    while (high.left() > 0) {
      const std::uint64_t word = high.number<std::uint32_t>();
      values.push_back(std::bit_cast<double>(word << 32 | low.number<std::uint32_t>()));
    }
  }
  return values;
}

Array array_of(UntrustedFile& file, const ExrPart& part, std::uint32_t part_number) {
  const std::vector<std::size_t> shape = exr_shape(part);
  const ExrPixels pixels = exr_pixels(part);
  if (!has_scan_lines(part) || !may_read(shape) || pixels == ExrPixels::other)
    return {shape, NotUsed{}};
  if (!is_zip(part)) throw broken_file("it is not compressed by ZIP");
  const bool single = pixels == ExrPixels::float32;
  const std::size_t line_bytes = shape[1] * (single ? sizeof(float) : sizeof(double));
  file.claim(std::uint64_t{shape[0]} * line_bytes);
  const std::string bytes = exr_lines(file, part, part_number, shape[0], line_bytes);
  if (single) return {shape, numbers_in<float>(bytes)};
  return {shape, doubles_of(bytes, shape[1])};
}

}  // namespace

StoredTables read_exr(std::string_view bytes) {
  UntrustedFile file(bytes);
  const std::vector<ExrPart> parts = exr_parts(file, attribute_names());
  StoredTables stored;
  for (const std::string& name : attribute_names())
    if (!parts.empty() && parts[0].attributes.contains(name))
      stored.attributes[name] = value_of(parts[0].attributes.at(name));
  check_identity(stored);
  for (std::uint32_t k = 0; k < parts.size(); ++k) {
    const std::string name = exr_name(parts[k]);
    if (std::ranges::find(array_names(), name) == array_names().end()) continue;
    if (stored.arrays.contains(name)) throw broken_file("the array '" + name + "' is there twice");
    stored.arrays[name] = about_array(name, [&] { return array_of(file, parts[k], k); });
  }
  return stored;
}

}  // namespace vndf::io
