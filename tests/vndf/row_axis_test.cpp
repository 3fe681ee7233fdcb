// Where rows lie.
#include "vndf/row_axis.h"

#include <cmath>
#include <limits>

#include "support/catch.h"

using namespace vndf;
using vndf::test::Approx;

TEST_CASE("without knots rows are equidistant in the base coordinate") {
  const RowAxis axis({});
  CHECK(axis.row(0.3) == 0.3);
  CHECK(axis.base(0.3) == 0.3);
}

TEST_CASE("a row axis is linear between its knots, and its inverse undoes it") {
  const RowAxis axis({{0, 0}, {0.2, 0.6}, {0.8, 1}});
  CHECK(axis.row(0.1) == Approx(0.3));
  CHECK(axis.row(0.5) == Approx(0.8));
  for (const double row : {0.0, 0.1, 0.6, 0.61, 0.99, 1.0})
    CHECK(axis.row(axis.base(row)) == Approx(row).margin(1e-15));
}

TEST_CASE("a base coordinate outside the knots goes to the nearer end") {
  const RowAxis axis({{0, 0}, {0.2, 0.6}, {0.8, 1}});
  CHECK(axis.row(0.9) == 1);
  CHECK(axis.row(-1) == 0);
}
