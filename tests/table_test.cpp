// The quantile table and its lookup.
#include "vndf/table.h"

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include "catch.h"

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

/// Increasing rows with steps of very different sizes, some zero.
QuantileTable rough_table(std::mt19937& random) {
  constexpr std::size_t kRows = 4, kColumns = 12;
  std::vector<float> values;
  for (std::size_t i = 0; i < kRows; ++i) {
    std::vector<float> row{0};
    for (std::size_t j = 1; j < kColumns; ++j) {
      const auto step = static_cast<float>(random() % 5);
      row.push_back(row.back() + step * step * step);
    }
    for (const float w : row) values.push_back(w / (row.back() + 1));
  }
  return {kRows, kColumns, values};
}

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
            Approx(table.row(i)[j]).epsilon(1e-15));
}

TEST_CASE("the lookup is exact for parabolas along a row and lines across rows") {
  const auto f = [](double r, double c) { return (c * c / 2 + c / 4) * (1 + r) / 2; };
  const auto table = table_of(3, 9, f);
  for (const double r : {0.0, 0.2, 0.7, 1.0})
    for (double c = 0; c <= 1; c += 0.03)
      CHECK(table.lookup(r, c) == Approx(f(r, c)).margin(1e-7));  // the values are single precision
}

TEST_CASE("the lookup converges with the third power of the column spacing or better") {
  const auto f = [](double, double c) { return std::sin(1.5 * c); };
  const auto worst = [&](std::size_t columns) {
    const auto table = table_of(2, columns, f);
    double error = 0;
    for (double c = 0.1; c < 0.9; c += 0.00137)
      error = std::max(error, std::abs(table.lookup(0.5, c) - f(0, c)));
    return error;
  };
  CHECK(worst(17) < worst(9) / 7);
}

TEST_CASE("the lookup increases along every row, between rows too, however rough the values") {
  std::mt19937 random(7);
  for (int trial = 0; trial < 200; ++trial) {
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
  constexpr double kStep = 1e-9, kSteepest = 40;
  for (int i = 1; i < 60; ++i)
    for (int j = 1; j < 110; ++j) {
      const double r = i / 60.0, c = j / 110.0;
      const double w = table.lookup(r, c);
      REQUIRE(std::abs(table.lookup(r + kStep, c) - w) < kSteepest * kStep);
      REQUIRE(std::abs(table.lookup(r, c + kStep) - w) < kSteepest * kStep);
    }
}

TEST_CASE("a table of impossible size is refused") {
  const auto refused = [](std::size_t rows, std::size_t columns, std::size_t values,
                          RowBlend blend = RowBlend::linear) {
    CAPTURE(rows, columns, values);
    CHECK_THROWS_AS(QuantileTable(rows, columns, std::vector<float>(values), blend),
                    std::invalid_argument);
  };
  refused(0, 3, 0);
  refused(2, 2, 4);
  refused(2, 3, 3);
  refused(2, 3, 7);
  refused(3, 3, 9, RowBlend::cubic);
}

TEST_CASE("a cubic blend is exact for cubics from row to row, up to the outermost rows") {
  std::vector<double> values;
  const auto height = [](double r) { return 0.2 + 0.3 * r - 0.4 * r * r + 0.5 * r * r * r; };
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 5; ++j) values.push_back(height(i / 5.0) * j / 4.0);
  const auto table = QuantileTable::with_double_values(6, 5, values, RowBlend::cubic);
  CHECK(table.in_double());
  for (double r = 0; r <= 1; r += 0.01)
    for (const double t : {0.0, 0.3, 0.5, 1.0})
      CHECK(table.lookup(r, t) == Approx(height(r) * t).margin(1e-15));
}

TEST_CASE("a table in double precision serves both precisions") {
  const std::vector<double> values{0, 1.0 / 3, 1, 0, 2.0 / 3, 1};
  const auto table = QuantileTable::with_double_values(2, 3, values);
  CHECK(table.row<double>(0)[1] == 1.0 / 3);
  CHECK(table.row(0)[1] == 1.0f / 3);
  CHECK(table.lookup(0.0, 0.5) == 1.0 / 3);
  CHECK(table.lookup(0.0f, 0.5f) == 1.0f / 3);
}

TEST_CASE("a table of one row does not depend on the row") {
  const QuantileTable table(1, 3, std::vector<float>{0, 0.25f, 1});
  for (const double row : {0.0, 0.4, 1.0}) CHECK(table.lookup(row, 0.5) == 0.25);
}
