// The quantile table and its lookup.
#include "vndf/table.h"

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include "support/catch.h"

using namespace vndf;
using vndf::test::Approx;

namespace {

QuantileTable table_of(std::size_t rows, std::size_t columns,
                       double (*f)(double row, double column)) {
  std::vector<float> values;
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t j = 0; j < columns; ++j)
      values.push_back(
          static_cast<float>(f(static_cast<double>(i) / static_cast<double>(rows - 1),
                               static_cast<double>(j) / static_cast<double>(columns - 1))));
  return {rows, columns, values};
}

constexpr std::size_t kRoughRows = 4, kRoughColumns = 12;

/// Rows that do not decrease, with steps of very different sizes, the cubes of `least` to least
/// + 4.
template <class T>
std::vector<T> rough_values(std::mt19937& random, int least) {
  std::vector<T> values;
  for (std::size_t i = 0; i < kRoughRows; ++i) {
    std::vector<T> row{0};
    for (std::size_t j = 1; j < kRoughColumns; ++j) {
      const auto step = static_cast<T>(least + static_cast<int>(random() % 5));
      row.push_back(row.back() + step * step * step);
    }
    for (const T w : row) values.push_back(w / (row.back() + 1));
  }
  return values;
}

/// In single precision, with flat parts.
QuantileTable rough_table(std::mt19937& random) {
  return {kRoughRows, kRoughColumns, rough_values<float>(random, 0)};
}

/// In double precision, everywhere increasing.
QuantileTable increasing_table(std::mt19937& random) {
  return QuantileTable::with_double_values(kRoughRows, kRoughColumns,
                                           rough_values<double>(random, 1));
}

/// The step of central differences.
constexpr double kStep = 1e-6;

}  // namespace

TEST_CASE("a cell is the node below and the fraction above it") {
  CHECK(cell_of(0.0, 11).index == 0);
  CHECK(cell_of(0.55, 11).index == 5);
  CHECK(cell_of(0.55, 11).fraction == Approx(0.5));
  CHECK(cell_of(1.0, 11).index == 9);
  CHECK(cell_of(1.0, 11).fraction == 1);
}

TEST_CASE("a coordinate outside [0, 1] or not a number goes to an end") {
  CHECK(cell_of(-3.0, 11).index == 0);
  CHECK(cell_of(-3.0, 11).fraction == 0);
  CHECK(cell_of(7.0, 11).index == 9);
  CHECK(cell_of(7.0, 11).fraction == 1);
  CHECK(cell_of(std::numeric_limits<double>::quiet_NaN(), 11).index == 0);
}

TEST_CASE("the lookup returns the nodes at the nodes") {
  const auto table = table_of(5, 9, [](double r, double c) { return c * (0.5 + 0.25 * r * r); });
  for (std::size_t i = 0; i < 5; ++i)
    for (std::size_t j = 0; j < 9; ++j)
      CHECK(table.lookup(static_cast<double>(i) / 4, static_cast<double>(j) / 8) ==
            Approx(table.row(i)[j].value).epsilon(1e-15));
}

TEST_CASE("the lookup is exact for cubics along a row and lines across rows") {
  const auto f = [](double r, double c) { return (c * c * c / 2 + c / 4) * (1 + r) / 2; };
  const auto table = table_of(3, 9, f);
  for (const double r : {0.0, 0.2, 0.7, 1.0})
    for (double c = 0; c <= 1; c += 0.03)
      CHECK(table.lookup(r, c) == Approx(f(r, c)).margin(1e-7));  // the values are single precision
}

TEST_CASE("the lookup converges with the fourth power of the column spacing") {
  const auto worst = [](std::size_t columns) {
    std::vector<double> values;
    for (int row = 0; row < 2; ++row)
      for (std::size_t j = 0; j < columns; ++j)
        values.push_back(std::sin(1.5 * static_cast<double>(j) / static_cast<double>(columns - 1)));
    const auto table = QuantileTable::with_double_values(2, columns, values);
    double error = 0;
    for (double c = 0; c <= 1; c += 0.00137)
      error = std::max(error, std::abs(table.lookup(0.5, c) - std::sin(1.5 * c)));
    return error;
  };
  // A doubling divides the error by 2^4, and by a little less at a finite spacing.
  CHECK(worst(33) < worst(17) / 14);
}

TEST_CASE("tangents are the derivatives of quartics, to the ends of a row") {
  const auto quartic = [](double t) { return t * t * t * t / 16 + t / 2; };
  std::vector<double> row;
  for (int j = 0; j < 9; ++j) row.push_back(quartic(j / 8.0));
  const auto nodes = nodes_of_row(row.data(), row.size());
  for (std::size_t j = 0; j < 9; ++j) {
    const double t = static_cast<double>(j) / 8, per_node = 1 / 8.0;
    CHECK(nodes[j].value == row[j]);
    CHECK(nodes[j].tangent == Approx((t * t * t / 4 + 0.5) * per_node).epsilon(1e-13));
  }
}

TEST_CASE(
    "a row that begins like t^2 has no slope at its first value, one that begins like t has") {
  std::vector<double> flat, steep;
  for (int j = 0; j < 9; ++j) {
    const double t = j / 8.0;
    flat.push_back(t * t / 2 - t * t * t * t / 3);
    steep.push_back(t * (1 + t) / 2);
  }
  const auto nodes = nodes_of_row(flat.data(), flat.size());
  CHECK(nodes[0].tangent == 0);
  CHECK(nodes[1].tangent == Approx((1 / 8.0 - 4.0 / 3 / 512) / 8).epsilon(1e-12));
  CHECK(nodes_of_row(steep.data(), steep.size())[0].tangent == Approx(1 / 16.0));
}

TEST_CASE("after a jump, where the quartic turns back, no tangent is 0") {
  const std::vector<double> row{0, 0.5, 0.52, 0.56, 0.62, 0.7};
  for (const auto& node : nodes_of_row(row.data(), row.size())) CHECK(node.tangent > 0);
}

TEST_CASE("tangents are at most three times the difference to either neighbour, and not negative") {
  const std::vector<double> row{0, 0, 0.5, 0.5, 0.51, 0.9, 1};
  const auto nodes = nodes_of_row(row.data(), row.size());
  for (std::size_t j = 0; j < row.size(); ++j) {
    CHECK(nodes[j].tangent >= 0);
    if (j > 0) CHECK(nodes[j].tangent <= 3 * (row[j] - row[j - 1]));
    if (j + 1 < row.size()) CHECK(nodes[j].tangent <= 3 * (row[j + 1] - row[j]));
  }
}

TEST_CASE("the lookup increases along every row, between rows too, however rough the values") {
  std::mt19937 random(7);
  for (int trial = 0; trial < 400; ++trial) {
    const auto table = rough_table(random);
    for (const double row : {0.0, 0.1, 0.5, 0.8, 1.0}) {
      double last = 0;
      for (int k = 0; k <= 500; ++k) {
        const double w = table.lookup(row, k / 500.0);
        REQUIRE(w >= last - 1e-15);
        REQUIRE(w <= 1);
        last = w;
      }
    }
  }
}

TEST_CASE("the lookup is continuous across rows and columns") {
  std::mt19937 random(11);
  const auto table = rough_table(random);
  constexpr double kNear = 1e-9, kMostSlope = 40;
  for (int i = 1; i < 60; ++i)
    for (int j = 1; j < 110; ++j) {
      const double r = i / 60.0, c = j / 110.0;
      const double w = table.lookup(r, c);
      REQUIRE(std::abs(table.lookup(r + kNear, c) - w) < kMostSlope * kNear);
      REQUIRE(std::abs(table.lookup(r, c + kNear) - w) < kMostSlope * kNear);
    }
}

TEST_CASE("a table of impossible size is an error") {
  const auto expect_error = [](std::size_t rows, std::size_t columns, std::size_t values) {
    CAPTURE(rows, columns, values);
    CHECK_THROWS_AS(QuantileTable(rows, columns, std::vector<float>(values)),
                    std::invalid_argument);
  };
  expect_error(0, 5, 0);
  expect_error(1, 5, 5);
  expect_error(2, 4, 8);
  expect_error(2, 5, 5);
  expect_error(2, 5, 11);
}

TEST_CASE("a table keeps values in the precision that they are given in") {
  const std::vector<double> values{0, 0.1, 1.0 / 3, 0.9, 1, 0, 0.1, 2.0 / 3, 0.9, 1};
  const auto table = QuantileTable::with_double_values(2, 5, values);
  CHECK(table.in_double());
  CHECK(table.lookup(0, 0.5) == 1.0 / 3);
  const QuantileTable single(2, 5, std::vector<float>(values.begin(), values.end()));
  CHECK_FALSE(single.in_double());
  CHECK(single.lookup(0, 0.5) == double{1.0f / 3});
}

TEST_CASE("the derivative of a row is that of its lookup, with the same value") {
  std::mt19937 random(5);
  for (int trial = 0; trial < 50; ++trial) {
    const QuantileTable table = increasing_table(random);
    for (const double row : {0.0, 0.3, 1.0})
      for (double t = 0.003; t < 1; t += 0.0173) {
        const auto at = table.lookup_with_derivative(row, t);
        REQUIRE(at.value == table.lookup(row, t));
        // The second derivative jumps at nodes, by up to 12^2 times the steepest rise.
        REQUIRE(at.derivative ==
                Approx((table.lookup(row, t + kStep) - table.lookup(row, t - kStep)) / (2 * kStep))
                    .margin(12 * 12 * 12 * kStep));
      }
  }
}

TEST_CASE("a row is inverted to rounding, between rows too") {
  std::mt19937 random(9);
  for (int trial = 0; trial < 50; ++trial) {
    const QuantileTable table = increasing_table(random);
    for (const double row : {0.0, 0.3, 1.0})
      for (int k = 0; k <= 300; ++k) {
        const double t = k / 300.0;
        REQUIRE(table.inverse(row, table.lookup(row, t)) == Approx(t).margin(1e-10));
      }
  }
}

TEST_CASE(
    "a value outside a row has its nearer end as inverse, one on a flat part a column of it") {
  const auto table =
      QuantileTable::with_double_values(2, 5, {0, 0.2, 0.2, 0.2, 0.7, 0, 0.2, 0.2, 0.2, 0.7});
  CHECK(table.inverse(0.5, -1.0) == 0);
  CHECK(table.inverse(0.5, 0.9) == 1);
  const double flat = table.inverse(0.5, 0.2);
  CHECK(flat >= 0.25);
  CHECK(flat <= 0.75);
  CHECK(table.lookup_with_derivative(0.5, 0.5).derivative == 0);
}
