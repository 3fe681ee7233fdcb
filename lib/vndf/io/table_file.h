// Slope tables on disk, with where they came from and how exact they are. HDF5 is the format of
// record; EXR holds the same bits for renderers that have OpenEXR only. tables/FORMAT.md describes
// both.
#pragma once

#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

#include "vndf/certificate.h"
#include "vndf/io/content_checksum.h"
#include "vndf/io/table_format.h"
#include "vndf/slope_tables.h"

namespace vndf::io {

/// How to make the file again.
struct Provenance {
  std::string recipe;               ///< the command that makes the file again
  std::string program;              ///< name and version of the program that wrote it
  std::string input_checksum = {};  ///< CRC-64/XZ of the file that the recipe reads; or empty
  std::string notes = {};           ///< what was found on the way, for people; lines, or empty
};

struct TableFile {
  std::shared_ptr<const SlopeTables> tables;
  Provenance provenance;
  Certificate certificate;
};

/// A file that cannot be read or written. The message names the file, the rule that it breaks, and
/// what to do.
class TableFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

enum class Format { hdf5, exr };

/// The format that the extension names: .h5, .hdf5 or .exr in either case. Throws TableFileError
/// for any other.
Format format_for(const std::filesystem::path& path);

/// Writes `file` in the format of the extension. The same content gives the same bytes. Throws
/// TableFileError; then nothing is left behind and a file already at `path` is as it was.
void save(const std::filesystem::path& path, const TableFile& file);

/// Reads a file of either format, recognised by its content. What it returns is bit-identical to
/// what was saved; a file with any damage is refused. Throws TableFileError.
///
/// Thread-safe in itself. A program that also uses HDF5 elsewhere, on another thread and built
/// without thread safety, must not do so during save() and load() of HDF5 files.
TableFile load(const std::filesystem::path& path);

}  // namespace vndf::io
