// The kernel on a GPU: whether it computes what it must, and how fast it is beside spherical caps.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "vndf/kernel_tables.h"

namespace vndf::bench {

/// A sampler with its tables in one kind of memory.
struct CudaEntry {
  std::string name;  ///< "caps", or the memory that the tables are in
  double coherent =
      0;              ///< samples per second, median of all rounds, of one direction and roughness
  double random = 0;  ///< the same, with a direction and a roughness for each sample
  int registers = 0;
  std::size_t spilled_bytes = 0;  ///< for each thread
};

struct CudaReport {
  std::string device;
  std::vector<CudaEntry> entries;  ///< caps first
  std::size_t golden_vectors = 0, golden_failures = 0;
  std::string first_failure;  ///< the result that differs in the first of the failures
};

struct CudaOptions {
  std::size_t golden_vectors = 100000;
  std::size_t samples = std::size_t{1} << 28;  ///< drawn for each time
  int rounds = 9;                              ///< in each of which everything is timed once
};

/// Runs the golden vectors of `tables` on the first CUDA device, and times the samplers. Throws
/// std::runtime_error where there is no device, and where the program was built without CUDA.
CudaReport run_cuda_bench(const KernelTables& tables, const CudaOptions& options = {});

/// The report as a table in Markdown, with rates also in multiples of that of caps.
std::string describe(const CudaReport& report);

/// The same as one object.
nlohmann::ordered_json to_json(const CudaReport& report);

}  // namespace vndf::bench
