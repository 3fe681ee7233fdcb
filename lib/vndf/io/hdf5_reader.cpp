// From the root group of an HDF5 file to attributes and arrays.
#include "vndf/io/hdf5_reader.h"

#include <algorithm>

#include "vndf/io/hdf5_dataset.h"
#include "vndf/io/hdf5_group.h"
#include "vndf/io/hdf5_values.h"

namespace vndf::io {
namespace {

void read_attribute(std::string_view message, StoredTables& stored) {
  const Hdf5Attribute attribute = hdf5_attribute(message);
  const std::string name(attribute.name);
  if (std::ranges::find(attribute_names(), name) == attribute_names().end()) return;
  if (!stored.attributes.emplace(name, hdf5_attribute_value(attribute)).second)
    throw broken_file("the attribute '" + name + "' is there twice");
}

}  // namespace

StoredTables read_hdf5(std::string_view bytes) {
  UntrustedFile file(bytes);
  const Hdf5Object root = hdf5_object(file, hdf5_root(file));
  StoredTables stored;
  for (const Hdf5Message& message : root)
    if (message.kind == Hdf5Kind::attribute) read_attribute(message.body, stored);
  check_identity(stored);
  for (const auto& [name, address] : hdf5_links(file, root, array_names()))
    stored.arrays[name] =
        about_array(name, [&, at = address] { return hdf5_array(file, hdf5_object(file, at)); });
  return stored;
}

}  // namespace vndf::io
