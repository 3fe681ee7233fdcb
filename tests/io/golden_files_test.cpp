// Files of every released version of the format that this program reads. Each holds the tables of
// `vndf build ggx --size 16`.
#include <string>

#include "support/catch.h"
#include "vndf/distributions/parse_distribution.h"
#include "vndf/io/table_file.h"
#include "vndf/precompute/measure_certificate.h"

using namespace vndf;
using vndf::test::Approx;

namespace {

io::TableFile golden(const std::string& name) {
  return io::load(std::string(VNDF_GOLDEN_FOLDER) + "/" + name);
}

}  // namespace

TEST_CASE("files of version 4.0 are read, and err by what their certificates say") {
  const auto ggx = distributions::parse_distribution("ggx");
  const precompute::UnitSlopes slopes(*ggx, {});
  for (const std::string name : {"ggx-4.0.h5", "ggx-4.0.exr"}) {
    CAPTURE(name);
    const io::TableFile file = golden(name);
    CHECK(file.tables->distribution == "ggx");
    CHECK(file.provenance.specification == Specification{"ggx"});
    const Certificate today = precompute::measure_certificate(slopes, file.tables, {});
    // Another processor's exp() may round the last bit of a place the other way.
    const auto same = [](double a, double b) { CHECK(a == Approx(b).epsilon(1e-2)); };
    same(today.marginal.max_u_error, file.certificate.marginal.max_u_error);
    same(today.marginal.mean_u_error, file.certificate.marginal.mean_u_error);
    same(today.conditional.max_u_error, file.certificate.conditional.max_u_error);
    same(today.conditional.mean_u_error, file.certificate.conditional.mean_u_error);
  }
}

TEST_CASE("the golden files of both containers hold the same tables") {
  const auto checksum = [](const io::TableFile& file) {
    return io::content_checksum(*file.tables, file.provenance.specification);
  };
  CHECK(checksum(golden("ggx-4.0.h5")) == checksum(golden("ggx-4.0.exr")));
}
