// The rules that tables must keep.
#include "vndf/slope_tables.h"

#include <limits>
#include <stdexcept>
#include <vector>

#include "support/catch.h"

using namespace vndf;
using vndf::test::contains;

namespace {

const std::vector<float> kRows{0, 0.25f, 0.5f, 0.75f, 1, 0, 0.125f, 0.25f, 0.5f, 1};

SlopeTables good_tables() {
  const LogCurve<double> curve({{0, 1, Grading::none, {{0, 0}, {-1, -1}}}}, true);
  return {.distribution = "test",
          .mean_slope = 1,
          .marginal = QuantileTable(2, 5, kRows),
          .conditional = QuantileTable(2, 5, kRows),
          .marginal_rows = {},
          .conditional_rows = {},
          .marginal_map = {{0, 1}, {1, 1}},
          .log_ndf = curve,
          .log_backfacing = curve};
}

/// What share() says of tables whose marginal value (row, column) is `value`.
std::string error_of(std::size_t row, std::size_t column, float value) {
  auto values = kRows;
  values[row * 5 + column] = value;
  auto tables = good_tables();
  tables.marginal = QuantileTable(2, 5, values);
  return check(tables).value_or("");
}

}  // namespace

TEST_CASE("good tables are shared") {
  CHECK(share(good_tables())->distribution == "test");
}

TEST_CASE("a value that is not a number is an error, with its place") {
  CHECK(error_of(1, 1, std::numeric_limits<float>::quiet_NaN()) ==
        "marginal table, row 1: column 1 is not a finite number");
}

TEST_CASE("a value outside [0, 1] is an error") {
  CHECK(error_of(0, 2, 1.5f) == "marginal table, row 0: column 2 is outside [0, 1]");
}

TEST_CASE("a row that decreases is an error") {
  CHECK(error_of(1, 2, 0.0625f) == "marginal table, row 1: column 2 is below the column before it");
}

TEST_CASE("a map that decreases, does not begin at 0 or has a bad tangent is an error") {
  const auto error_of = [](std::vector<CubicNode<double>> map) {
    auto tables = good_tables();
    tables.marginal_map = std::move(map);
    return check(tables).value_or("");
  };
  CHECK(error_of({{0, 0}, {0.5, 1}, {1, 0}}).empty());
  CHECK(error_of({}) == "marginal map: fewer than two nodes, or the first value is not 0");
  CHECK(error_of({{0.1, 0}, {1, 0}}) ==
        "marginal map: fewer than two nodes, or the first value is not 0");
  const std::string rule = ": not at or above the node before it in [0, 1], with a tangent >= 0";
  CHECK(error_of({{0, 0}, {0.5, 1}, {0.4, 0}}) == "marginal map, node 2" + rule);
  CHECK(error_of({{0, 0}, {1, -1}}) == "marginal map, node 1" + rule);
  CHECK(error_of({{0, 0}, {1.5, 0}}) == "marginal map, node 1" + rule);
}

TEST_CASE("a row that does not begin at 0 is an error") {
  CHECK(error_of(0, 0, 0.25f) ==
        "marginal table, row 0: column 0 is not 0, the value at the end of a row");
}

TEST_CASE("a mean slope that is not > 0 is an error") {
  auto tables = good_tables();
  tables.mean_slope = 0;
  CHECK_THROWS_WITH(share(tables), contains("mean slope"));
}

TEST_CASE("missing tables and curves are errors") {
  auto tables = good_tables();
  tables.conditional = {};
  CHECK_THROWS_WITH(share(tables), contains("conditional table: empty"));
  tables = good_tables();
  tables.log_ndf = {};
  CHECK_THROWS_WITH(share(tables), contains("log_ndf curve: no segments"));
}

TEST_CASE("a curve with bad nodes or ends is an error") {
  const double infinity = std::numeric_limits<double>::infinity();
  const auto expect_error = [](std::vector<LogCurveSegment<double>> segments,
                               const std::string& why) {
    auto tables = good_tables();
    tables.log_backfacing = {std::move(segments), true};
    CHECK_THROWS_WITH(share(tables), contains("log_backfacing curve, segment") && contains(why));
  };
  expect_error({{0, 1, Grading::none, {{0, 0}, {infinity, 0}}}}, "a node is not a finite number");
  expect_error({{0, 1, Grading::none, {{0, 0}}}}, "fewer than two nodes");
  expect_error({{1, 1, Grading::none, {{0, 0}, {0, 0}}}}, "ends are not increasing");
  expect_error({{0, 1, static_cast<Grading>(7), {{0, 0}, {0, 0}}}}, "unknown grading");
}

TEST_CASE("a row axis whose knots do not increase from row 0 to row 1 is an error") {
  const auto expect_error = [](std::vector<RowKnot> knots) {
    auto tables = good_tables();
    tables.conditional_rows = std::move(knots);
    CHECK_THROWS_WITH(share(tables), contains("conditional rows"));
  };
  expect_error({{0, 0}});
  expect_error({{0, 0}, {1, 0.5}});
  expect_error({{0, 0}, {0.5, 0.7}, {0.4, 0.8}, {1, 1}});
  expect_error({{0, 0}, {0.5, 0.5}, {0.6, 0.5}, {1, 1}});
}

TEST_CASE("a scale of the conditional without meaning and a support that is not > 0 are errors") {
  auto tables = good_tables();
  tables.conditional_constant = 0;
  CHECK_THROWS_WITH(share(tables), contains("scale of the conditional"));
  tables = good_tables();
  tables.conditional_quadratic = std::numeric_limits<double>::infinity();
  CHECK_THROWS_WITH(share(tables), contains("scale of the conditional"));
  tables = good_tables();
  tables.support = 0;
  CHECK_THROWS_WITH(share(tables), contains("support"));
}

TEST_CASE("a conditional factorises where all its rows are equal, to the last bit") {
  auto tables = good_tables();
  CHECK_FALSE(conditional_factorises(tables));
  std::vector<double> row{0, 0.1, 0.3, 0.6, 1}, rows = row;
  rows.insert(rows.end(), row.begin(), row.end());
  tables.conditional = QuantileTable::with_double_values(2, 5, rows);
  CHECK(conditional_factorises(tables));
  rows.back() = 1 - 0x1p-53;
  tables.conditional = QuantileTable::with_double_values(2, 5, rows);
  CHECK_FALSE(conditional_factorises(tables));
}
