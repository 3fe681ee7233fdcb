// The conditional distribution and its inverse, against closed forms.
#include "vndf/precompute/conditional_distribution.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "support/catch.h"
#include "support/closed_forms.h"
#include "support/tolerances.h"
#include "vndf/distributions/families.h"
#include "vndf/distributions/parse_distribution.h"

using namespace vndf;
using namespace vndf::distributions;
using namespace vndf::precompute;
using namespace vndf::test;

namespace {

const std::vector<double> kSmall{1e-12, 1e-9, 1e-6, 1e-3, 0.02, 0.1, 0.3, 0.5};

/// `places` are slopes in the distribution's own units.
template <class Forms>
void check_quantiles(const std::vector<double>& places) {
  const auto distribution = parse_distribution(Forms::name);
  const UnitSlopes slopes(*distribution, {});
  for (const double x : places) {
    const ConditionalDistribution conditional(slopes, x / slopes.mean_slope(), plain_scale(slopes));
    const double unit =
        std::hypot(slopes.mean_slope(), x);  // of y, in the distribution's own units
    // p22 magnifies the rounding of r^2 by up to r^2, which the quadrature sees as its own error.
    CHECK(conditional.quadrature_error() < kIntegralError * (1 + std::min(x * x, 100.0)));
    const auto tail = [&](double y) { return 2 * Forms::conditional(x, -y * unit); };
    for (const double e : kSmall) {
      CAPTURE(Forms::name, x, e);
      CHECK(std::abs(tail(conditional.quantile({1 - e, e})) - e) <= kQuantileError);
      CHECK(std::abs(tail(conditional.quantile({e, 1 - e})) - (1 - e)) <= kQuantileError);
      CHECK(conditional.cdf(conditional.quantile({e, 1 - e})).u == Approx(e).epsilon(1e-11));
      CHECK(conditional.cdf(conditional.quantile({1 - e, e})).complement ==
            Approx(e).epsilon(1e-11));
    }
  }
}

}  // namespace

TEST_CASE("conditional quantiles invert the closed CDF to 1e-12 in both tails") {
  check_quantiles<BeckmannForms>({0, 1e-6, 0.1, 1, 3, 10});
  check_quantiles<GgxForms>({0, 1e-6, 0.1, 1, 30, 1e4, 1e8});
}

TEST_CASE("the ends of the conditional are infinity and 0") {
  const Ggx ggx;
  const UnitSlopes slopes(ggx, {});
  const ConditionalDistribution conditional(slopes, 0.5, plain_scale(slopes));
  CHECK(conditional.quantile({1, 0}) == std::numeric_limits<double>::infinity());
  CHECK(conditional.quantile({0, 1}) == 0);
  CHECK(conditional.cdf(0).complement == Approx(1).epsilon(1e-14));
}

TEST_CASE("a slope where the density is lost in double precision is not reachable") {
  const Beckmann beckmann;
  const UnitSlopes slopes(beckmann, {});
  CHECK(ConditionalDistribution::reachable(slopes, 10));
  CHECK_FALSE(ConditionalDistribution::reachable(slopes, 60));
}

TEST_CASE("the conditional of a disk is uniform up to its edge") {
  const UniformDisk disk;
  const UnitSlopes slopes(disk, {});
  for (const double x : {0.0, 0.3, 0.9, 0.999}) {
    const ConditionalDistribution conditional(slopes, x / slopes.mean_slope(), plain_scale(slopes));
    for (const double p : {1e-6, 0.25, 0.5, 0.999999}) {
      CAPTURE(x, p);
      CHECK(conditional.quantile({p, 1 - p}) == Approx(p).epsilon(1e-9));
    }
    CHECK(conditional.quantile({1, 0}) == 1);
  }
}

TEST_CASE("the conditional of a ring leaves out its hole") {
  const Annulus ring(0.5);
  const UnitSlopes slopes(ring, {});
  const ConditionalDistribution conditional(slopes, 0, plain_scale(slopes));
  // Uniform in [1/2, 1].
  CHECK(conditional.quantile({1e-9, 1 - 1e-9}) == Approx(0.5).epsilon(1e-8));
  CHECK(conditional.quantile({0.5, 0.5}) == Approx(0.75).epsilon(1e-9));
}
