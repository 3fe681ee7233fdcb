// Files of every released version of the format, which all later versions must read. Each holds the
// tables of `vndf build NAME --size 12x16`, with `--rows cubic` where its name or version says so.
#include <string>

#include "catch.h"
#include "io/table_file.h"
#include "precompute/distribution_spec.h"
#include "precompute/measure_certificate.h"

using namespace vndf;
using vndf::test::Approx;

namespace {

const std::string kFolder = VNDF_GOLDEN_FOLDER;

/// Reads a file and measures its tables again.
void check_golden(const std::string& name, const std::string& spec) {
  CAPTURE(name);
  const io::TableFile golden = io::load(kFolder + "/" + name);
  CHECK(golden.tables->distribution == spec);
  CHECK(golden.provenance.recipe.find(spec) != std::string::npos);
  const auto distribution = precompute::parse_distribution(spec);
  const precompute::UnitSlopes slopes(*distribution, {});
  const Certificate today = precompute::measure_certificate(slopes, golden.tables, {});
  // Another processor's exp() may round the last bit of a place the other way.
  const auto same = [](double a, double b) { CHECK(a == Approx(b).epsilon(1e-2)); };
  same(today.marginal.max_u_error, golden.certificate.marginal.max_u_error);
  same(today.marginal.mean_u_error, golden.certificate.marginal.mean_u_error);
  same(today.conditional.max_u_error, golden.certificate.conditional.max_u_error);
  same(today.conditional.mean_u_error, golden.certificate.conditional.mean_u_error);
}

}  // namespace

TEST_CASE("files of version 1.0 are read, and err by what their certificates say") {
  check_golden("ggx-1.0.h5", "ggx");
  check_golden("ggx-1.0.exr", "ggx");
}

TEST_CASE("files of version 1.1, with a map, are read, and err by what their certificates say") {
  const std::string spec = "mixture:0.5*ggx+0.5*beckmann@0.01";
  check_golden("mixture-1.1.h5", spec);
  check_golden("mixture-1.1.exr", spec);
}

TEST_CASE(
    "files of version 1.1, with cubic rows, are read, and err by what their certificates say") {
  check_golden("ggx-cubic-1.1.h5", "ggx");
  check_golden("ggx-cubic-1.1.exr", "ggx");
}

TEST_CASE("files of version 1.2, with tangents by five points, are read, and err as they say") {
  check_golden("ggx-1.2.h5", "ggx");
  check_golden("ggx-1.2.exr", "ggx");
}

TEST_CASE("the golden files of both containers hold the same tables") {
  for (const std::string name : {"ggx-1.0", "mixture-1.1", "ggx-cubic-1.1", "ggx-1.2"})
    CHECK(io::content_checksum(*io::load(kFolder + "/" + name + ".h5").tables) ==
          io::content_checksum(*io::load(kFolder + "/" + name + ".exr").tables));
}
