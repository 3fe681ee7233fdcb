// Bakes the pair of a file, with the best certificate that can be had, for the commands that take a
// pair where baked tables are needed.
#pragma once

#include <string>

#include "commands/bake_options.h"
#include "vndf/io/table_file.h"
#include "vndf/kernel_tables.h"

namespace vndf::tools {

struct BakeRun {
  std::string command_line;  ///< written into the tables, for people
  unsigned threads = 0;      ///< 0 for one per processor
  bool show_progress = false;
};

/// Bakes `pair`, which was read from `path`. The certificate is measured against the distribution;
/// where that cannot be made again, a warning says so, and the certificate follows from the pair's.
KernelTables bake_pair(const std::string& path, const io::TableFile& pair,
                       const BakeArguments& arguments, const BakeRun& run);

}  // namespace vndf::tools
