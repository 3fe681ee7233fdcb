// What a table file holds: the tables, where they came from and how exact they are. The encoders of
// the formats need this type alone, and not the functions that load and save files.
#pragma once

#include <memory>

#include "vndf/certificate.h"
#include "vndf/provenance.h"
#include "vndf/slope_tables.h"

namespace vndf::io {

struct TableFile {
  std::shared_ptr<const SlopeTables> tables;
  Provenance provenance;
  Certificate certificate;
};

}  // namespace vndf::io
