// Reading messages of datatypes, dataspaces and attributes.
#include "vndf/io/hdf5_values.h"

namespace vndf::io {
namespace {

using namespace std::string_view_literals;

constexpr std::size_t kMostAxes = 32;  // of HDF5

/// Datatype messages after the byte of class and version: flags, bytes of a value, and for numbers
/// the places of their bits.
constexpr std::string_view kInt32 = "\x08\0\0\x04\0\0\0\0\0\x20\0"sv;
constexpr std::string_view kFloat32 = "\x20\x1f\0\x04\0\0\0\0\0\x20\0\x17\x08\0\x17\x7f\0\0\0"sv;
constexpr std::string_view kFloat64 = "\x20\x3f\0\x08\0\0\0\0\0\x40\0\x34\x0b\0\x34\xff\x03\0\0"sv;

enum Class { kInteger = 0, kFloat = 1, kText = 3 };
constexpr int kSpacePadding = 2;

constexpr std::uint8_t kFlagsOfShared = 3;  // of an attribute: its datatype, its dataspace

}  // namespace

Hdf5Type hdf5_type(std::string_view message) {
  ByteCursor cursor(message);
  const auto class_and_version = cursor.number<std::uint8_t>();
  const int kind = class_and_version & 15, version = class_and_version >> 4;
  if (version < 1 || version > 3) return Hdf5Type::other;
  const std::string_view rest = message.substr(1);
  if (kind == kInteger && rest.starts_with(kInt32)) return Hdf5Type::int32;
  if (kind == kFloat && rest.starts_with(kFloat32)) return Hdf5Type::float32;
  if (kind == kFloat && rest.starts_with(kFloat64)) return Hdf5Type::float64;
  if (kind == kText && (cursor.number<std::uint8_t>() & 15) < kSpacePadding) return Hdf5Type::text;
  return Hdf5Type::other;
}

std::size_t hdf5_value_bytes(std::string_view datatype_message) {
  ByteCursor cursor(datatype_message);
  cursor.take(4);
  return cursor.number<std::uint32_t>();
}

std::optional<std::vector<std::size_t>> hdf5_shape(std::string_view message) {
  ByteCursor cursor(message);
  const auto version = cursor.number<std::uint8_t>();
  const std::size_t axes = cursor.number<std::uint8_t>();
  cursor.take(1);  // whether the axes may grow
  const auto kind = cursor.number<std::uint8_t>();
  constexpr std::uint8_t kNoValues = 2;
  const bool known = version == 1 || (version == 2 && kind != kNoValues);
  if (!known || axes > kMostAxes) return {};
  if (version == 1) cursor.take(4);
  std::vector<std::size_t> shape;
  while (shape.size() < axes) shape.push_back(cursor.number<std::uint64_t>());
  return shape;
}

Hdf5Attribute hdf5_attribute(std::string_view message) {
  ByteCursor cursor(message);
  const auto version = cursor.number<std::uint8_t>();
  const auto flags = cursor.number<std::uint8_t>();
  if (version < 1 || version > 3) throw broken_file("an attribute is of an unknown HDF5 version");
  if (version > 1 && (flags & kFlagsOfShared) != 0)
    throw broken_file("an attribute has a committed datatype");
  const auto name_bytes = cursor.number<std::uint16_t>();
  const auto datatype_bytes = cursor.number<std::uint16_t>();
  const auto dataspace_bytes = cursor.number<std::uint16_t>();
  if (version == 3) cursor.take(1);  // the encoding of the name
  const auto part = [&](std::uint16_t count) {
    return version == 1 ? cursor.take_padded(count) : cursor.take(count);
  };
  Hdf5Attribute attribute;
  attribute.name = ByteCursor(part(name_bytes)).text();
  attribute.datatype = part(datatype_bytes);
  attribute.dataspace = part(dataspace_bytes);
  attribute.value = cursor.take(cursor.left());
  return attribute;
}

Attribute hdf5_attribute_value(const Hdf5Attribute& attribute) {
  const auto shape = hdf5_shape(attribute.dataspace);
  if (!shape || !shape->empty()) return NotUsed{};
  ByteCursor value(attribute.value);
  switch (hdf5_type(attribute.datatype)) {
    case Hdf5Type::int32:
      return int{value.number<std::int32_t>()};
    case Hdf5Type::float64:
      return value.number<double>();
    case Hdf5Type::text: {
      const std::size_t size = hdf5_value_bytes(attribute.datatype);
      if (size > kMaxTextBytes) return NotUsed{};
      const std::string_view text = value.take(size);
      return std::string(text.substr(0, text.find('\0')));
    }
    default:
      return NotUsed{};
  }
}

}  // namespace vndf::io
