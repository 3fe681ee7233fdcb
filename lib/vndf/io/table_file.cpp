// To load a file is to read its bytes, to check its trailer, to decode its format and to check its
// content. To save one is the reverse. Each step is in a file of its own.
#include "vndf/io/table_file.h"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "vndf/io/atomic_file.h"
#include "vndf/io/checksum_trailer.h"
#include "vndf/io/exr_reader.h"
#include "vndf/io/exr_writer.h"
#include "vndf/io/format_error.h"
#include "vndf/io/hdf5_reader.h"
#include "vndf/io/hdf5_writer.h"
#include "vndf/io/stored_tables.h"
#include "vndf/io/untrusted_file.h"

namespace vndf::io {
namespace {

/// Returns what `action` returns. Adds the name of the file to a FormatError that it throws.
template <class Action>
auto naming(const std::string& name, Action action) {
  try {
    return action();
  } catch (const FormatError& error) {
    throw TableFileError(name + ": " + error.what());
  }
}

Format format_of(std::string_view bytes) {
  if (bytes.starts_with(kHdf5Magic)) return Format::hdf5;
  if (bytes.starts_with(kExrMagic)) return Format::exr;
  throw FormatError("it is neither an HDF5 nor an EXR file", "give a file written by vndf");
}

std::uint64_t array_bytes(const StoredTables& stored) {
  std::uint64_t bytes = 0;
  for (const auto& [name, array] : stored.arrays) {
    if (const auto* f = std::get_if<std::vector<float>>(&array.values)) bytes += 4 * f->size();
    if (const auto* d = std::get_if<std::vector<double>>(&array.values)) bytes += 8 * d->size();
  }
  return bytes;
}

/// Refuses to write what no reader would take.
std::string encoded(Format format, const StoredTables& stored) {
  std::string bytes = format == Format::hdf5 ? write_hdf5(stored) : write_exr(stored);
  if (array_bytes(stored) > most_array_bytes(bytes.size()))
    throw FormatError("its arrays are larger than a file of its size may hold",
                      "make smaller tables, for their rows are almost the same");
  return bytes;
}

StoredTables decoded(Format format, std::string_view content) {
  return format == Format::hdf5 ? read_hdf5(content) : read_exr(content);
}

}  // namespace

Format format_for(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".h5" || extension == ".hdf5") return Format::hdf5;
  if (extension == ".exr") return Format::exr;
  throw TableFileError(path.string() +
                       ": its extension names no table format; use .h5, .hdf5 or .exr");
}

std::string to_bytes(Format format, const TableFile& file, const std::string& name) {
  return naming(name, [&] { return with_trailer(encoded(format, to_stored(file))); });
}

TableFile from_bytes(std::string_view bytes, const std::string& name) {
  return naming(name, [&] {
    const Format format = format_of(bytes);
    return from_stored(decoded(format, without_trailer(bytes)));
  });
}

void save(const std::filesystem::path& path, const TableFile& file) {
  const std::string bytes = to_bytes(format_for(path), file, path.string());
  naming(path.string(), [&] { replace_file(path, bytes); });
}

TableFile load(const std::filesystem::path& path) {
  return from_bytes(naming(path.string(), [&] { return read_file(path); }), path.string());
}

}  // namespace vndf::io
