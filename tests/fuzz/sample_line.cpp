// Bytes as the standard input of `vndf sample --stdin`.
#include "commands/sample_line.h"

#include <sstream>
#include <stdexcept>

#include "fuzz/fuzz_target.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vndf;
  fuzz::accept_or_throw<std::runtime_error>([&] {
    std::istringstream stream{std::string(fuzz::text_of(data, size))};
    for (std::string line; tools::next_sample_line(stream, line);) {
      const tools::SampleInputs inputs = tools::inputs_of(line);
      if (!tools::broken_rule<float>(inputs).empty()) continue;
      fuzz::require(!check(inputs.surface), "a line without a surface is accepted");
      fuzz::require(tools::broken_rule<double>(inputs).empty(), "single precision accepts more");
    }
  });
  return 0;
}
