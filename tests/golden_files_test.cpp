// Files of every released version of the format, which all later versions must read. Each holds the
// tables of `vndf build NAME --size 12x16`.
#include <algorithm>
#include <cmath>
#include <string>

#include "catch.h"
#include "io/table_file.h"
#include "precompute/build_tables.h"
#include "precompute/distribution_spec.h"

using namespace vndf;
using vndf::test::Approx;

namespace {

const std::string kFolder = VNDF_GOLDEN_FOLDER;

double largest_difference(const QuantileTable& a, const QuantileTable& b) {
  double difference = 0;
  for (std::size_t i = 0; i < a.rows(); ++i)
    for (std::size_t j = 0; j < a.columns(); ++j)
      difference = std::max(difference, std::abs(double{a.row(i)[j]} - double{b.row(i)[j]}));
  return difference;
}

void check_golden(const std::string& name, const std::string& spec) {
  CAPTURE(name);
  const io::TableFile golden = io::load(kFolder + "/" + name);
  CHECK(golden.tables->distribution == spec);
  CHECK(golden.provenance.recipe.find(spec) != std::string::npos);
  const auto built = precompute::build_tables(
      *precompute::parse_distribution(spec),
      {.layout = {golden.tables->marginal.rows(), golden.tables->marginal.columns()}});
  // Another processor's exp() may round the last bit of a value the other way.
  constexpr double kLastBit = 1.2e-7;
  CHECK(largest_difference(golden.tables->marginal, built.tables->marginal) <= kLastBit);
  CHECK(largest_difference(golden.tables->conditional, built.tables->conditional) <= kLastBit);
  CHECK(golden.tables->marginal_map.size() == built.tables->marginal_map.size());
  CHECK(golden.certificate.marginal.max_u_error ==
        Approx(built.certificate.marginal.max_u_error).epsilon(1e-3));
}

}  // namespace

TEST_CASE("files of version 1.0 are read, and hold what the builder makes today") {
  check_golden("ggx-1.0.h5", "ggx");
  check_golden("ggx-1.0.exr", "ggx");
}

TEST_CASE("files of version 1.1, with a map, are read, and hold what the builder makes today") {
  const std::string spec = "mixture:0.5*ggx+0.5*beckmann@0.01";
  check_golden("mixture-1.1.h5", spec);
  check_golden("mixture-1.1.exr", spec);
}

TEST_CASE("the golden files of both containers hold the same tables") {
  for (const std::string name : {"ggx-1.0", "mixture-1.1"})
    CHECK(io::content_checksum(*io::load(kFolder + "/" + name + ".h5").tables) ==
          io::content_checksum(*io::load(kFolder + "/" + name + ".exr").tables));
}
