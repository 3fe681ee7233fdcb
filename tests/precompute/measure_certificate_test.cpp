// The certificate: the shipped tables keep the README's promises, and wrong tables are found out.
#include "vndf/precompute/measure_certificate.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "support/built_tables.h"
#include "support/catch.h"
#include "support/tolerances.h"
#include "vndf/distributions/families.h"
#include "vndf/distributions/parse_distribution.h"
#include "vndf/precompute/build_tables.h"

using namespace vndf;
using namespace vndf::distributions;
using namespace vndf::precompute;
using namespace vndf::test;

namespace {

void check_ratios(const TailRatios& ratios) {
  CHECK(std::abs(ratios.e6 - 1) <= kTailRatioAt1e6);
  CHECK(std::abs(ratios.e5 - 1) <= kTailRatioAt1e5);
  CHECK(std::abs(ratios.e4 - 1) <= kTailRatioAt1e5);
}

void check_table(const TableErrors& errors) {
  CHECK(errors.max_u_error <= kLargeTableUError);
  CHECK(errors.mean_u_error < errors.max_u_error);
  check_ratios(errors.lower);
  check_ratios(errors.upper);
}

/// The values of a table with some of them changed.
QuantileTable changed(const QuantileTable& table,
                      const std::function<double(const double* row, std::size_t column)>& value) {
  std::vector<float> values;
  for (std::size_t i = 0; i < table.rows(); ++i)
    for (std::size_t j = 0; j < table.columns(); ++j)
      values.push_back(static_cast<float>(value(table.row_values(i).data(), j)));
  return {table.rows(), table.columns(), values};
}

Certificate measured(const std::string& distribution, SlopeTables tables) {
  const auto d = parse_distribution(distribution);
  const UnitSlopes slopes(*d, {});
  return measure_certificate(slopes, share(std::move(tables)), {});
}

}  // namespace

TEST_CASE("the shipped tables keep the bounds of the README") {
  for (const char* name : {"ggx", "beckmann"}) {
    const Certificate& c = large_tables(name).certificate;
    CAPTURE(name);
    check_table(c.marginal);
    check_table(c.conditional);
    CHECK(c.max_d_error <= kFunctionError);
    CHECK(c.max_lambda_error <= kFunctionError);
    CHECK(c.max_pdf_error <= kFunctionError);
  }
}

TEST_CASE("D is followed into a pole") {
  for (const char* name : {"k:nu=0.75", "k:nu=1"}) {
    CAPTURE(name);
    CHECK(small_tables(name).certificate.max_d_error <= kFunctionError);
  }
}

TEST_CASE("D is followed to the end of a steep rim") {
  // D ~ exp(-r^p) has fallen to 1e-12 = exp(-27.6) there, so a rounding of r counts 27.6 p times;
  // there are four of them.
  constexpr double kPower = 50, kRim = 27.6 * kPower * 4 * 0x1p-24;
  CHECK(small_tables("exponential-power:p=50").certificate.max_d_error <= kRim);
}

TEST_CASE("the error falls with the square of the rows") {
  const Ggx ggx;
  const auto coarse = build_tables(ggx, {.layout = {.rows = 32, .columns = 256}}).certificate;
  const auto fine = build_tables(ggx, {.layout = {.rows = 128, .columns = 256}}).certificate;
  CHECK(fine.marginal.max_u_error < coarse.marginal.max_u_error / 10);
}

TEST_CASE("a marginal table shifted by half a cell is found out") {
  SlopeTables tables = *large_tables("ggx").tables;
  tables.marginal = changed(tables.marginal, [](const double* row, std::size_t j) {
    return j == 0 ? 0 : (row[j] + row[j - 1]) / 2;
  });
  CHECK(measured("ggx", tables).marginal.max_u_error > 1e-3);
}

TEST_CASE("a tail cut at slope 16 is found out by the tail ratio") {
  SlopeTables tables = *large_tables("ggx").tables;
  const MonotoneMap map(tables.marginal_map);
  const double cut = map.inverse(bounded_from_slope(-16.0).sigma);
  tables.marginal = changed(tables.marginal, [&](const double* row, std::size_t j) {
    return j == 0 ? 0 : std::max(row[j], cut);
  });
  const Certificate c = measured("ggx", tables);
  CHECK(std::abs(c.marginal.lower.e5 - 1) > 0.5);
}

TEST_CASE("a conditional that is 0.01 % too wide is found out") {
  SlopeTables tables = *large_tables("beckmann").tables;
  tables.conditional = changed(tables.conditional, [](const double* row, std::size_t j) {
    return j == 0 || row[j] == 1 ? row[j] : row[j] * 0.9999;
  });
  CHECK(measured("beckmann", tables).conditional.max_u_error > 1e-5);
}

TEST_CASE("a masking function that is 0.3 % off is found out") {
  SlopeTables tables = *large_tables("beckmann").tables;
  auto segments = tables.log_backfacing.segments();
  for (auto& n : segments.front().nodes) n.value += 0.003;
  tables.log_backfacing = {segments, true};
  const Certificate c = measured("beckmann", tables);
  CHECK(c.max_lambda_error > 2.5e-3);
  CHECK(c.max_pdf_error > 5e-4);
}

TEST_CASE("tables of one distribution fail as those of another") {
  const Certificate c = measured("ggx", *large_tables("beckmann").tables);
  CHECK(c.marginal.max_u_error > 0.01);
  CHECK(c.conditional.max_u_error > 0.01);
  CHECK(c.max_d_error > 0.1);
}

TEST_CASE("the list of figures names each one once") {
  Certificate c;
  std::vector<std::string> names;
  for_each_figure(c, [&](const std::string& name, double) { names.push_back(name); });
  CHECK(names.size() == 36);
  std::sort(names.begin(), names.end());
  CHECK(std::adjacent_find(names.begin(), names.end()) == names.end());
}

TEST_CASE("a ring thinner than single precision is measured where it has slopes") {
  // The last rows lie so near to the rim that their slopes are rounded to beyond it.
  const Annulus ring(1 - 1e-8);
  const Certificate certificate =
      build_tables(ring, {.layout = {.rows = 64, .columns = 64}}).certificate;
  CHECK(std::isfinite(certificate.conditional.max_u_error));
  CHECK(certificate.conditional.max_u_error > 1e-3);
}
