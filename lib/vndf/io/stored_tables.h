// What a table file holds, as both formats can hold it: named attributes and named arrays. All
// rules about names, types, shapes, versions and values are here, so the formats' writers and
// readers know nothing of slopes.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "vndf/io/stored_names.h"
#include "vndf/io/table_content.h"

namespace vndf::io {

/// The value of something that a file holds but in a type or size that this version does not use.
struct NotUsed {
  bool operator==(const NotUsed&) const = default;
};

using Attribute = std::variant<NotUsed, int, double, std::string>;

/// Row-major values, as many as the product of `shape`.
struct Array {
  std::vector<std::size_t> shape;
  std::variant<NotUsed, std::vector<float>, std::vector<double>> values;

  bool operator==(const Array&) const = default;
};

/// Sorted by name, so that the same content is written in the same order.
struct StoredTables {
  std::map<std::string, Attribute> attributes;
  std::map<std::string, Array> arrays;

  bool operator==(const StoredTables&) const = default;
};

/// True if an array of this shape may be read: two axes, neither empty nor over every limit of
/// table_format.h. A reader leaves the values of any other array NotUsed and allocates nothing.
bool may_read(const std::vector<std::size_t>& shape);

/// Throws FormatError unless the attributes are those of a table file of this version, with texts
/// that keep the rules. Every reader calls it before it looks at arrays.
void check_identity(const StoredTables& stored);

/// Throws FormatError if the tables are missing or break a rule of check() or a limit of the
/// format.
StoredTables to_stored(const TableFile& file);

/// The value that the attribute `content_checksum` of these tables must have. Throws FormatError
/// where attributes and arrays do not make tables.
std::string stored_checksum(const StoredTables& stored);

/// Throws FormatError with the first rule that is broken: the file's type, version, name of
/// coordinates, attributes and arrays with their types and shapes, content checksum, check().
TableFile from_stored(const StoredTables& stored);

}  // namespace vndf::io
