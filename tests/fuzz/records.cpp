// Bytes as records of somebody's sampler.
#include "vndf/validate/records.h"

#include <sstream>
#include <stdexcept>
#include <string>

#include "fuzz/fuzz_target.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vndf;
  fuzz::accept_or_throw<std::runtime_error>([&] {
    std::istringstream stream{std::string(fuzz::text_of(data, size))};
    const validate::Records records = validate::read_records(stream, "records.csv");
    for (const validate::Record& record : records.list) {
      const double length = dot(record.wm, record.wm);
      fuzz::require(length > 0.5 && length < 2, "a record has no normal");
      fuzz::require(record.configuration.alpha.x > 0, "a record has no roughness");
    }
  });
  return 0;
}
