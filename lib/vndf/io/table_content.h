// What a table file holds: the tables, where they came from and how exact they are. The encoders of
// the formats need this type alone, and not the functions that load and save files.
#pragma once

#include <memory>
#include <string>

#include "vndf/certificate.h"
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

}  // namespace vndf::io
