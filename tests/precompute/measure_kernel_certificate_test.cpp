// The certificate of a kernel: as good as what was asked for, and wrong tables are found out.
#include <algorithm>
#include <cmath>
#include <string>

#include "support/baked_tables.h"
#include "support/catch.h"
#include "vndf/distributions/parse_distribution.h"
#include "vndf/precompute/bake_certified.h"
#include "vndf/precompute/measure_kernel_certificate.h"
#include "vndf/validate/validate.h"

using namespace vndf;
using namespace vndf::distributions;
using namespace vndf::precompute;
using namespace vndf::test;

namespace {

Certificate measured(const std::string& distribution, const Kernel& kernel) {
  const auto d = parse_distribution(distribution);
  return measure_certificate(UnitSlopes(*d, {}), kernel, {});
}

/// The tables of `distribution` after `change` of their header.
template <class Change>
KernelTables changed(const std::string& distribution, Change change) {
  Block block(baked_tables(distribution).bytes());
  change(block.header());
  block.set_checksum();
  return KernelTables::copy(block.bytes());
}

}  // namespace

TEST_CASE("the errors of a kernel are those of its pair and the tolerance") {
  // The tolerance is kept at some places of each cell and between them but little exceeded.
  constexpr double kWithin = 1.1 * kBakedWithin;
  for (const std::string distribution : {"ggx", kMixture}) {
    const Certificate pair = small_tables(distribution).certificate;
    const Certificate c = measured(distribution, baked_tables(distribution).kernel());
    CAPTURE(distribution);
    CHECK(c.marginal.max_u_error <= pair.marginal.max_u_error + kWithin);
    CHECK(c.below.max_u_error <= pair.below.max_u_error + kWithin);
    CHECK(c.conditional.max_u_error <= pair.conditional.max_u_error + kWithin);
    CHECK(c.marginal.mean_u_error < c.marginal.max_u_error);
    CHECK(c.max_d_error <= pair.max_d_error + kWithin);
    CHECK(c.max_lambda_error <= pair.max_lambda_error + kWithin);
    CHECK(c.max_pdf_error <= pair.max_pdf_error + 2 * kWithin);
  }
}

TEST_CASE("a kernel of one distribution fails as that of another") {
  const Certificate c = measured("ggx", baked_tables("beckmann").kernel());
  CHECK(c.marginal.max_u_error > 0.01);
  CHECK(c.conditional.max_u_error > 0.01);
  CHECK(c.max_d_error > 0.1);
  CHECK(c.max_lambda_error > 0.01);
}

TEST_CASE("slopes that are a thousandth too long are found out, in both tables") {
  const KernelTables longer = changed("ggx", [](KernelHeader& h) { h.unit *= 1.001f; });
  const Certificate c = measured("ggx", longer.kernel());
  const Certificate right = measured("ggx", baked_tables("ggx").kernel());
  CHECK(c.marginal.max_u_error > right.marginal.max_u_error + 1e-4);
  CHECK(c.below.max_u_error > right.below.max_u_error + 1e-4);
  CHECK(c.max_d_error > 1e-3);
}

TEST_CASE("a tail that ends too early is found out by the tail ratio") {
  // sigma of a slope that one in 4e5 normals exceeds at grazing incidence.
  const KernelTables cut = changed("ggx", [](KernelHeader& h) { h.least_root = 0.025f; });
  CHECK(measured("ggx", cut.kernel()).marginal.lower.e6 < 0.5);
}

TEST_CASE("baking measures, and says so") {
  const auto d = parse_distribution("ggx");
  const UnitSlopes slopes(*d, {});
  const SlopeTables& pair = *small_tables("ggx").tables;
  const KernelTables tables =
      bake_certified(slopes, pair, {.tolerance = kBakedWithin}, {"ggx"}, {});
  CHECK(tables.header().certified == 1);
  CHECK(tables.text().distribution == "ggx");
  CHECK(tables.certificate().marginal.max_u_error ==
        measured("ggx", tables.kernel()).marginal.max_u_error);
}

TEST_CASE(
    "without the distribution the certificate is the pair's with the differences, and says so") {
  const auto& built = small_tables("ggx");
  const KernelText text{"", {.specification = {}, .notes = "a note"}};
  const KernelTables tables =
      bake_uncertified(*built.tables, built.certificate, {.tolerance = kBakedWithin}, text);
  const Certificate c = tables.certificate();
  CHECK(tables.header().certified == 0);
  CHECK(tables.text().provenance.notes == "a note");
  CHECK(c.marginal.max_u_error ==
        built.certificate.marginal.max_u_error + tables.header().difference_x);
  CHECK(c.conditional.max_u_error ==
        built.certificate.conditional.max_u_error + tables.header().difference_y);
  CHECK(std::isinf(c.marginal.max_density_error));
  CHECK(c.max_d_error == built.certificate.max_d_error + kBakedWithin);
}

TEST_CASE("the validator passes a kernel and rejects that of another distribution") {
  const auto verdict_of = [](const std::string& name, const KernelTables& tables) {
    const auto own = std::make_shared<validate::ExactSlopes>(parse_distribution("ggx"));
    const KernelTables certified = tables.with_certificate(measured(name, tables.kernel()), true);
    return validate::validate_sampler(
        validate::baked_tables_under_test(name, own, certified),
        {.thoroughness = validate::Thoroughness::quick, .seed = 5, .stop_at_first_failure = true});
  };
  const validate::Verdict right = verdict_of("ggx", baked_tables("ggx"));
  for (const auto& f : right.results) {
    CAPTURE(f.check, f.statistic, f.measured, f.bound);
    CHECK(f.passed());
  }
  CHECK_FALSE(verdict_of("beckmann", baked_tables("beckmann")).passed());
}
