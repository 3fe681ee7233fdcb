// What HDF5 messages say of types, shapes and values of attributes (section IV.A.2).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "vndf/io/byte_cursor.h"
#include "vndf/io/stored_tables.h"

namespace vndf::io {

/// The types that the format has, little-endian. No value of any other is looked at.
enum class Hdf5Type { other, int32, float32, float64, text };

/// The type that a datatype message describes.
Hdf5Type hdf5_type(std::string_view message);

/// Bytes of one value of a type that hdf5_type() knows.
std::size_t hdf5_value_bytes(std::string_view datatype_message);

/// The lengths of the axes that a dataspace message describes, none for a single value; nothing
/// where it has no values or more axes than HDF5 allows.
std::optional<std::vector<std::size_t>> hdf5_shape(std::string_view message);

struct Hdf5Attribute {
  std::string_view name;
  std::string_view datatype, dataspace;  ///< messages
  std::string_view value;
};

/// The parts of an attribute message. Throws FormatError where it refers to a committed datatype.
Hdf5Attribute hdf5_attribute(std::string_view message);

/// The value of an attribute: NotUsed unless it is one 32-bit integer, one float64 or one text of
/// at most kMaxTextBytes, padded with zeros. Throws FormatError if there are too few bytes.
Attribute hdf5_attribute_value(const Hdf5Attribute& attribute);

}  // namespace vndf::io
