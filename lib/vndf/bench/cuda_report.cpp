// Prints what a GPU did.
#include <fmt/format.h>

#include "vndf/bench/cuda_bench.h"

namespace vndf::bench {

std::string describe(const CudaReport& report) {
  std::string text = fmt::format("{}\n\n", report.device);
  text += fmt::format("golden vectors: {} of {} are within their tolerance\n",
                      report.golden_vectors - report.golden_failures, report.golden_vectors);
  if (report.golden_failures > 0)
    text += fmt::format("the first that is not: {}\n", report.first_failure);
  text +=
      "\n| sampler | coherent, 1e9/s | over caps | random, 1e9/s | over caps | registers | spilled "
      "bytes |\n|---|---|---|---|---|---|---|\n";
  for (const CudaEntry& entry : report.entries) {
    const CudaEntry& caps = report.entries.front();
    text += fmt::format("| {} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {} | {} |\n", entry.name,
                        entry.coherent / 1e9, entry.coherent / caps.coherent, entry.random / 1e9,
                        entry.random / caps.random, entry.registers, entry.spilled_bytes);
  }
  return text;
}

nlohmann::ordered_json to_json(const CudaReport& report) {
  nlohmann::ordered_json json{{"device", report.device},
                              {"golden_vectors", report.golden_vectors},
                              {"golden_failures", report.golden_failures},
                              {"first_failure", report.first_failure}};
  for (const CudaEntry& entry : report.entries)
    json["samplers"].push_back({{"name", entry.name},
                                {"coherent_per_second", entry.coherent},
                                {"random_per_second", entry.random},
                                {"registers", entry.registers},
                                {"spilled_bytes", entry.spilled_bytes}});
  return json;
}

}  // namespace vndf::bench
