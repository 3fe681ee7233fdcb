// asinh of a slope and its bounded form.
#include "vndf/precompute/asinh_slope.h"

#include <limits>

#include "support/catch.h"

using namespace vndf;
using namespace vndf::precompute;
using vndf::test::Approx;

TEST_CASE("asinh and the bounded form of a slope convert into each other") {
  for (const double a : {-30.0, -1.0, 0.0, 0.5, 20.0})
    CHECK(asinh_of(bounded_from_asinh(a)) == Approx(a).margin(1e-15));
}

TEST_CASE("infinite slopes have an infinite asinh") {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  CHECK(asinh_of({1, 0}) == kInfinity);
  CHECK(asinh_of({0, 1}) == -kInfinity);
  CHECK(bounded_from_asinh(kInfinity).sigma == 1);
  CHECK(bounded_from_asinh(-kInfinity).sigma == 0);
}
