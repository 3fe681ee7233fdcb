// The distribution of the radius is compared with one-dimensional integrals of another kind, with
// the visible area of Cartesian slopes, and with the radial CDFs that are known in closed form.
#include "vndf/validate/exact/radial_distribution.h"

#include <cmath>

#include "support/catch.h"
#include "support/samplers_under_test.h"

using namespace vndf;
using namespace vndf::validate;
using namespace vndf::test;

namespace {

const std::vector<std::string> kDistributions{"beckmann", "ggx",     "student-t:gamma=1.55",
                                              "disk",     "annulus", "exponential-power:p=0.5"};
const std::vector<double> kAngles{0, 0.01, 10, 45, 80, 89.9, 90 - 1e-7, 90, 90 + 1e-7, 92.5, 99};

BoundedSlope<double> cotangent(double degrees) {
  return bounded_cotangent(degrees == 90 ? 0 : std::cos(degrees * kDegree),
                           std::sin(degrees * kDegree));
}

}  // namespace

TEST_CASE("the radius of all GGX and Beckmann slopes has the closed distribution") {
  for (const std::string name : {"ggx", "beckmann"}) {
    const auto slopes = exact_slopes(name);
    const double mu = slopes->unit_slopes().mean_slope();
    for (double r = 1e-3; r < 5; r *= 1.1) {
      const double square = r * r;
      const double above = name == "ggx" ? 1 / (1 + square) : std::exp(-square);
      const auto cdf = slopes->all_radii().cdf(std::asinh(r / mu));
      CHECK(cdf.u == Approx(1 - above).margin(kRadialError));
      CHECK(cdf.complement == Approx(above).epsilon(kRadialTailError));
    }
  }
}

TEST_CASE("the visible area of the radial distribution is that of the Cartesian one") {
  for (const auto& name : kDistributions) {
    const auto slopes = exact_slopes(name);
    for (const double degrees : kAngles) {
      const auto c = cotangent(degrees);
      const double cosine = c.numerator() / c.hypotenuse(), sine = c.denominator() / c.hypotenuse();
      const double hidden =
          sine > 0 ? sine * slopes->unit_slopes().backfacing(std::abs(cosine) / sine).value : 0;
      CAPTURE(name, degrees);
      CHECK(RadialDistribution(slopes->unit_slopes(), c).visible_area() ==
            Approx(std::max(cosine, 0.0) + hidden).epsilon(1e-9));
    }
  }
}

TEST_CASE("the tabulated radial CDF agrees with the integral, in both tails relative") {
  for (const auto& name : kDistributions) {
    const auto slopes = exact_slopes(name);
    for (const double degrees : kAngles) {
      const auto c = cotangent(degrees);
      const RadialDistribution radii(slopes->unit_slopes(), c);
      for (double a = 1e-3; a < 12; a *= 1.17) {
        const auto table = radii.cdf(a),
                   exact = radial_cdf(slopes->unit_slopes(), slopes->all_radii(), c, a);
        CAPTURE(name, degrees, a);
        CHECK(std::abs(table.u - exact.u) < kRadialError);
        if (exact.u > kRadialSmallestTail)
          CHECK(table.u == Approx(exact.u).epsilon(kRadialTailError));
        if (exact.complement > 1e-6)  // the integral is a difference there
          CHECK(table.complement == Approx(exact.complement).epsilon(kRadialTailError));
      }
    }
  }
}

TEST_CASE("the radial CDF runs from 0 at the pole to 1 at the horizon and never falls") {
  const auto slopes = exact_slopes("student-t:gamma=1.55");
  const RadialDistribution radii(slopes->unit_slopes(), cotangent(70));
  CHECK(radii.cdf(0).u == 0);
  CHECK(radii.cdf(std::numeric_limits<double>::infinity()).complement == 0);
  double last = 0;
  for (double a = 0; a < 150; a += 0.01) {
    const double u = radii.cdf(a).u;
    CHECK(u >= last);
    last = u;
  }
}
