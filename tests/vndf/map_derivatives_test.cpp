// The derivatives beside the functions that they are of, against differences, and the inverse of a
// row.
#include <cmath>
#include <random>
#include <vector>

#include "support/catch.h"
#include "vndf/cubic_piece.h"
#include "vndf/monotone_map.h"
#include "vndf/table.h"
#include "vndf/table_coordinates.h"

using namespace vndf;
using vndf::test::Approx;

namespace {

constexpr double kStep = 1e-6, kDifferenceError = 1e-7;

template <class F>
double difference(F f, double x) {
  return (f(x + kStep) - f(x - kStep)) / (2 * kStep);
}

/// Rows that increase by steps of very different sizes, in double precision.
QuantileTable rough_table(std::mt19937& random) {
  constexpr std::size_t kRows = 5, kColumns = 12;
  std::vector<double> values;
  for (std::size_t i = 0; i < kRows; ++i) {
    std::vector<double> row{0};
    for (std::size_t j = 1; j < kColumns; ++j) {
      const double step = 1 + static_cast<double>(random() % 5);
      row.push_back(row.back() + step * step * step);
    }
    for (const double w : row) values.push_back(w / row.back());
  }
  return QuantileTable::with_double_values(kRows, kColumns, values);
}

}  // namespace

TEST_CASE("the derivative of a row is that of its lookup, with the same value") {
  std::mt19937 random(5);
  for (int trial = 0; trial < 50; ++trial) {
    const QuantileTable table = rough_table(random);
    for (const double row : {0.0, 0.3, 1.0})
      for (double t = 0.003; t < 1; t += 0.0173) {
        const auto at = table.lookup_with_derivative(row, t);
        REQUIRE(at.value == table.lookup(row, t));
        // The second derivative jumps at nodes, by up to 12^2 times the steepest rise.
        REQUIRE(at.derivative ==
                Approx(difference([&](double s) { return table.lookup(row, s); }, t))
                    .margin(12 * 12 * 12 * kStep));
      }
  }
}

TEST_CASE("a row is inverted to rounding, between rows too") {
  std::mt19937 random(9);
  for (int trial = 0; trial < 50; ++trial) {
    const QuantileTable table = rough_table(random);
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

TEST_CASE("the derivative of a map is that of its values") {
  const MonotoneMap map({{0, 0}, {0.1, 0.15}, {0.5, 0.2}, {1, 0.6}});
  for (double s = 0.01; s < 1; s += 0.0371) {
    const auto at = map.at_with_derivative(s);
    CHECK(at.value == map.at(s));
    CHECK(at.derivative ==
          Approx(difference([&](double v) { return map.at(v); }, s)).epsilon(1e-4));
  }
}

TEST_CASE("the rates of the columns are the derivatives of their inverses, and 0 at the ends") {
  for (double t = 0.01; t < 1; t += 0.01) {
    CHECK(marginal_column_rate(t) ==
          Approx(difference([](double s) { return marginal_column_inverse(s).u; }, t))
              .margin(kDifferenceError));
    CHECK(conditional_column_rate(t) ==
          Approx(difference([](double s) { return conditional_column_inverse(s).u; }, t))
              .margin(kDifferenceError));
  }
  for (const double end : {0.0, 1.0}) {
    CHECK(marginal_column_rate(end) == 0);
    CHECK(conditional_column_rate(end) == 0);
  }
  CHECK(conditional_column_rate(1e-9) == Approx(4e-9).epsilon(1e-6));
}

TEST_CASE("unfold undoes fold") {
  for (const double u : {0.0, 1e-9, 0.3, 0.5, 0.7, 1 - 1e-9, 1.0})
    CHECK(unfold(fold(probability(u))) == Approx(u).epsilon(1e-15));
}

TEST_CASE("a fraction is bounded as its quotient is, infinite at denominator 0") {
  for (const double x : {-3.0, -1e-9, 0.0, 0.7, 1e12}) {
    const auto whole = bounded_from_slope(x), part = bounded_from_fraction(x * 1e-20, 1e-20);
    CHECK(part.sigma == Approx(whole.sigma).epsilon(1e-14));
    CHECK(part.complement == Approx(whole.complement).epsilon(1e-14));
  }
  CHECK(bounded_from_fraction(-1.0, 0.0).sigma == 0);
  CHECK(bounded_from_fraction(1.0, 0.0).complement == 0);
}
