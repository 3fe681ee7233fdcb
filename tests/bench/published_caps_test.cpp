// The unit of the benchmark is a correct sampler: its distribution, and the error of float.
#include "vndf/bench/published_caps.h"

#include "support/catch.h"
#include "support/pair_test.h"
#include "support/tolerances.h"

using namespace vndf;
using namespace vndf::test;
using vndf::bench::PublishedCaps;

TEST_CASE("spherical caps as published pass a chi-square test of both slopes together") {
  for (const double degrees : {0.0, 30.0, 75.0, 89.0})
    for (const Alpha<double>& alpha : {Alpha<double>{1, 1}, Alpha<double>{0.3, 0.05}}) {
      CAPTURE(degrees, alpha.x, alpha.y);
      CHECK(visible_p_value<GgxForms>(PublishedCaps(), direction_at<double>(degrees, 35), alpha) >
            kSignificance);
    }
}

TEST_CASE("spherical caps as published keep their stated error in float") {
  for (const double degrees : {0.0, 1e-5, 1.0, 30.0, 60.0, 89.0, 89.9})
    for (const float alpha : {1.0f, 0.1f}) {
      CAPTURE(degrees, alpha);
      CHECK(rounding_error<GgxForms>(PublishedCaps(), PublishedCaps(),
                                     direction_at<float>(degrees, 20),
                                     Alpha<float>{alpha, alpha}) <= PublishedCaps::kFloatError);
    }
}
