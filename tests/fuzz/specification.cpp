// Bytes as the specification of a distribution, which every file of tables carries.
#include <stdexcept>
#include <string>

#include "fuzz/fuzz_target.h"
#include "vndf/distributions/specification.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vndf;
  Specification specification{std::string(fuzz::text_of(data, size))};
  if (specification.text.starts_with("profile"))
    specification = {specification.text, {0, 0.5, 1, 2, 3}, {1, 0.5, 0.25, 0.125, 0.0625}};
  fuzz::accept_or_throw<std::exception>([&] {
    const auto distribution = distributions::make_distribution(specification);
    fuzz::require(distribution != nullptr, "no distribution and no error");
    fuzz::require(distribution->p22(0.5) >= 0, "a density is negative or not a number");
  });
  return 0;
}
