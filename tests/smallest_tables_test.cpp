// The search for the smallest tables.
#include "precompute/smallest_tables.h"

#include <algorithm>
#include <string>

#include "catch.h"
#include "precompute/distribution_spec.h"

using namespace vndf;
using namespace vndf::precompute;
using vndf::test::contains;

namespace {

BuiltTables smallest(const std::string& spec, double tolerance, std::size_t bytes) {
  return smallest_tables(*parse_distribution(spec), {tolerance, bytes});
}

double error_of(const BuiltTables& built) {
  return std::max(built.certificate.marginal.max_u_error,
                  built.certificate.conditional.max_u_error);
}

}  // namespace

TEST_CASE("both tables of Beckmann and GGX keep 1e-5 in 64 KiB, as their certificates say") {
  for (const std::string spec : {"beckmann", "ggx"}) {
    CAPTURE(spec);
    const BuiltTables built = smallest(spec, 1e-5, 65536);
    CHECK(error_of(built) <= 1e-5);
    CHECK(sampling_bytes(*built.tables) <= 65536);
    CHECK(built.tables->conditional.rows() == 1);
  }
}

TEST_CASE("a larger tolerance takes fewer bytes") {
  const auto fine = smallest("ggx", 1e-5, 65536), coarse = smallest("ggx", 1e-3, 65536);
  CHECK(error_of(coarse) <= 1e-3);
  CHECK(sampling_bytes(*coarse.tables) < sampling_bytes(*fine.tables) / 2);
}

TEST_CASE("a conditional that does not factorise is found too") {
  const BuiltTables built = smallest("exponential-power:p=8", 5e-5, 65536);
  CHECK(error_of(built) <= 5e-5);
  CHECK(sampling_bytes(*built.tables) <= 65536);
  CHECK(built.tables->conditional.rows() > 1);
}

TEST_CASE("a tolerance that no table of the size keeps is refused, with the nearest there is") {
  CHECK_THROWS_WITH(smallest("ggx", 1e-9, 4096),
                    contains("no marginal table of at most 4096 bytes") && contains("errs by"));
  CHECK_THROWS_WITH(smallest("ggx", 1e-5, 10), contains("none that was tried is so small"));
}
