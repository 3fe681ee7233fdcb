// Loads and saves slope tables. HDF5 is the format of record; EXR holds the same bits for renderers
// that have OpenEXR only. tables/FORMAT.md describes both.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

#include "vndf/io/content_checksum.h"
#include "vndf/io/table_content.h"
#include "vndf/io/table_format.h"

namespace vndf::io {

/// The error of a file that cannot be read or written. The message names the file, the rule that it
/// breaks, and what to do.
class TableFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

enum class Format { hdf5, exr };

/// Returns the format that the extension names: .h5, .hdf5 or .exr in either case. Throws
/// TableFileError for any other extension.
Format format_for(const std::filesystem::path& path);

/// Writes `file` in the format of the extension. The same content gives the same bytes. Throws
/// TableFileError on any failure. Then nothing is left behind, and a file that was at `path` before
/// is unchanged.
void save(const std::filesystem::path& path, const TableFile& file);

/// Reads a file of either format, which it recognises by the first bytes and not by the name. What
/// it returns is bit-identical to what was saved; a file with any damage is refused. Throws
/// TableFileError.
///
/// This function is thread-safe. But a program that uses HDF5 elsewhere, on another thread and with
/// an HDF5 library built without thread safety, must not do so during save() and load() of HDF5
/// files.
TableFile load(const std::filesystem::path& path);

/// The bytes of the file that save() writes, and the content of such bytes, for whoever keeps files
/// elsewhere. Throw TableFileError, which calls the file `name`, as save() and load() do.
std::string to_bytes(Format format, const TableFile& file, const std::string& name);
TableFile from_bytes(std::string_view bytes, const std::string& name);

}  // namespace vndf::io
