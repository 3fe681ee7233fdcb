// Bytes as a measured profile, up to the distribution that the builder would work on.
#include <sstream>
#include <stdexcept>
#include <string>

#include "fuzz/fuzz_target.h"
#include "vndf/distributions/diagnose.h"
#include "vndf/distributions/measured_profile.h"
#include "vndf/distributions/profile_csv.h"

namespace {

using namespace vndf;
using distributions::ProfileTail;

void make(const distributions::RadialProfile& samples, ProfileTail tail) {
  fuzz::accept_or_throw<std::exception>([&] {
    const distributions::MeasuredProfile profile("p", samples, tail);
    distributions::diagnose(profile);
    fuzz::require(profile.mass() > 0 && profile.mean_slope() > 0, "a profile has no mass");
    for (const double r : {0.0, 1e-3, 1.0, 1e3})
      fuzz::require(profile.p22(r) >= 0, "a density is negative or not a number");
  });
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::accept_or_throw<std::runtime_error>([&] {
    std::istringstream stream{std::string(fuzz::text_of(data, size))};
    const auto samples = distributions::read_profile_csv(stream, "profile.csv");
    fuzz::accept_or_throw<std::exception>(
        [&] { make(distributions::smoothed(samples).profile, ProfileTail::none); });
    for (const auto tail : {ProfileTail::none, ProfileTail::exponential, ProfileTail::power})
      make(samples, tail);
  });
  return 0;
}
