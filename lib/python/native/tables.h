// Tables as Python has them: the pair, the tables baked from it, or both.
#pragma once

#include <memory>
#include <optional>

#include "normals.h"
#include "source.h"
#include "vndf/io/table_file.h"
#include "vndf/kernel_tables.h"

namespace vndf::python {

/// At least one of the two is there.
struct Tables {
  std::optional<io::TableFile> pair = {};
  std::optional<KernelTables> kernel = {};
  /// What they were built from, where that was in this process.
  std::optional<Source> built_from = {};

  Sampler sampler() const;
  /// The distribution that they were made from. Its specification is empty where a function of
  /// Python's was lost, and nothing can be made of it.
  Source source() const;
};

}  // namespace vndf::python
