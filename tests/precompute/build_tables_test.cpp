// The builder: what it fills, that it does not depend on threads, what it throws for.
#include "vndf/precompute/build_tables.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <numbers>
#include <stdexcept>

#include "support/built_tables.h"
#include "support/catch.h"
#include "support/closed_forms.h"
#include "support/tolerances.h"
#include "vndf/distributions/families.h"
#include "vndf/distributions/parse_distribution.h"
#include "vndf/distributions/slope_integrals.h"
#include "vndf/table_coordinates.h"

using namespace vndf;
using namespace vndf::distributions;
using namespace vndf::precompute;
using namespace vndf::test;

namespace {

bool same_bits(const QuantileTable& a, const QuantileTable& b) {
  if (a.rows() != b.rows() || a.columns() != b.columns()) return false;
  for (std::size_t i = 0; i < a.rows(); ++i)
    if (a.row_values(i) != b.row_values(i)) return false;
  return true;
}

bool same_bits(const LogCurve<double>& a, const LogCurve<double>& b) {
  if (a.segments().size() != b.segments().size()) return false;
  for (std::size_t i = 0; i < a.segments().size(); ++i) {
    const auto &s = a.segments()[i], &t = b.segments()[i];
    if (s.begin != t.begin || s.end != t.end || s.nodes.size() != t.nodes.size() ||
        std::memcmp(s.nodes.data(), t.nodes.data(), s.nodes.size() * sizeof(s.nodes[0])) != 0)
      return false;
  }
  return true;
}

}  // namespace

TEST_CASE("the tables are the same bits for any number of threads") {
  const Ggx ggx;
  const auto one = build_tables(ggx, {.layout = {.rows = 40, .columns = 50}, .threads = 1});
  const auto five = build_tables(ggx, {.layout = {.rows = 40, .columns = 50}, .threads = 5});
  CHECK(same_bits(one.tables->marginal, five.tables->marginal));
  CHECK(same_bits(one.tables->conditional, five.tables->conditional));
  CHECK(same_bits(one.tables->log_ndf, five.tables->log_ndf));
  CHECK(same_bits(one.tables->log_backfacing, five.tables->log_backfacing));
  CHECK(one.certificate.marginal.max_u_error == five.certificate.marginal.max_u_error);
}

/// The visible CDF of GGX at slope -t, seen from cotangent -k, without the cancellation of
/// visible_cdf() (marginal_distribution_test.cpp).
double ggx_cdf_from_below(double k, double t) {
  const auto beyond = [](double at) { return 1 / (2 * (std::hypot(1, at) + at)); };
  return (beyond(t) + (t - k) * GgxForms::q(t)) / beyond(k);
}

TEST_CASE("every entry of the marginal table is the quantile at its node") {
  const auto& tables = *small_tables("ggx").tables;
  const MonotoneMap map(tables.marginal_map);
  const RowAxis axis(tables.marginal_rows);
  const auto last_row = static_cast<double>(tables.marginal.rows() - 1);
  const auto last_column = static_cast<double>(tables.marginal.columns() - 1);
  for (std::size_t i = 0; i < tables.marginal.rows(); ++i) {
    const auto c = marginal_base_inverse(axis.base(static_cast<double>(i) / last_row));
    for (std::size_t j = 1; j + 1 < tables.marginal.columns(); ++j) {
      const auto u = marginal_column_inverse(static_cast<double>(j) / last_column);
      const double sigma = marginal_scale(c) * map.at(tables.marginal.row(i)[j].value);
      const double x = bounded_from_sigma(sigma).slope();
      const double cosine = c.numerator() / c.hypotenuse(), sine = c.denominator() / c.hypotenuse();
      CAPTURE(i, j);
      // The value s is rounded by 2^-25. The base probability changes 4 times as fast at most, and
      // u by up to its norm for GGX, 1 + pi / 2, faster than that (marginal_map_test.cpp). Below
      // the horizon u changes up to twice as fast with t = sigma(x) / scale as at the horizon: as
      // 4 t - 4 t^2 from far below, in place of 2 t.
      const bool below = c.sigma < c.complement;
      const double cdf = below ? ggx_cdf_from_below(-c.slope(), std::max(-x, -c.slope()))
                               : visible_cdf<GgxForms>(cosine, sine, x);
      REQUIRE(std::abs(cdf - u.u) <= (below ? 2 : 1) * 0x1p-25 * 4 * (1 + std::numbers::pi / 2));
    }
  }
}

TEST_CASE("rows of a light tail end where no sample lands") {
  const auto& tables = *small_tables("exponential-power:p=1").tables;
  REQUIRE(tables.conditional_rows.size() >= 2);
  CHECK(tables.conditional_rows.back().base < 1);
  CHECK(small_tables("student-t:gamma=3").tables->conditional_rows.empty());
}

TEST_CASE("D goes on falling beyond its curve, however steep the tail") {
  for (const std::string name : {"blinn-phong:n=50", "student-t:gamma=20", "student-t:gamma=60"}) {
    const auto& ndf = small_tables(name).tables->log_ndf;
    const auto& last = ndf.segments().back();
    const double gamma =
        name == "blinn-phong:n=50" ? 27 : std::stod(name.substr(name.find('=') + 1));
    CAPTURE(name, last.end);
    // p22 ~ r^(-2 gamma) there, and D ~ p22 r^4; asinh(r) is log(2 r).
    CHECK(ndf.log_slope_at(2 * last.end) == Approx(4 - 2 * gamma).epsilon(1e-4));
  }
}

TEST_CASE("a density at another scale gives the same tables, and its mass is reported") {
  class Scaled final : public SlopeDistribution {
   public:
    std::string name() const override { return "scaled"; }
    double p22(double r) const override { return 8 * ggx_.p22(r); }

   private:
    Ggx ggx_;
  };
  const Scaled scaled;
  const Ggx ggx;
  const BuildOptions options{.layout = {.rows = 32, .columns = 32}};
  const auto a = build_tables(scaled, options), b = build_tables(ggx, options);
  CHECK(a.mass == Approx(8).epsilon(1e-13));
  CHECK(same_bits(a.tables->marginal, b.tables->marginal));
  CHECK(same_bits(a.tables->conditional, b.tables->conditional));
}

TEST_CASE("progress is reported from nothing to everything") {
  double last = 0;
  const Ggx ggx;
  build_tables(
      ggx, {.layout = {.rows = 8, .columns = 8}, .threads = 2, .progress = [&](double fraction) {
              CHECK(fraction >= last);
              last = fraction;
            }});
  CHECK(last == 1);
}

TEST_CASE("impossible sizes are refused") {
  const Ggx ggx;
  CHECK_THROWS_WITH(build_tables(ggx, {.layout = {.rows = 1, .columns = 64}}),
                    contains("table size 1x64"));
  CHECK_THROWS_AS(build_tables(ggx, {.layout = {.rows = 64, .columns = 4}}), std::invalid_argument);
  CHECK_THROWS_AS(build_tables(ggx, {.layout = {.rows = 20000, .columns = 64}}),
                  std::invalid_argument);
}

TEST_CASE("names that are not known are refused with those that are") {
  CHECK_THROWS_WITH(parse_distribution("gxx"), contains("'gxx'") && contains("beckmann, ggx"));
}
