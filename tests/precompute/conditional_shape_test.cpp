// Which conditionals are one distribution times a scale: exactly those that theory says.
#include "vndf/precompute/conditional_shape.h"

#include <string>

#include "support/catch.h"
#include "vndf/distributions/parse_distribution.h"

using namespace vndf;
using namespace vndf::distributions;
using namespace vndf::precompute;
using vndf::test::Approx;

namespace {

ConditionalShape shape_of(const std::string& spec) {
  const auto d = parse_distribution(spec);
  return conditional_shape(UnitSlopes(*d, {}));
}

}  // namespace

TEST_CASE("Gaussian, Student-T and Pearson II conditionals factorise") {
  for (const std::string spec :
       {"beckmann", "ggx", "student-t:gamma=1.55", "student-t:gamma=4", "hyper-cauchy",
        "blinn-phong", "disk", "pearson-ii:m=1.5", "exponential-power:p=2", "mixture:1*ggx@0.3"}) {
    CAPTURE(spec);
    CHECK(shape_of(spec).factorises);
  }
}

TEST_CASE("no other conditional does") {
  for (const std::string spec : {"exponential-power:p=1.99", "exponential-power:p=0.5",
                                 "exponential-power:p=8", "k", "k:nu=3", "annulus", "volcano",
                                 "mixture:0.9*ggx+0.1*beckmann", "mixture:1*ggx+1*ggx@0.9"}) {
    CAPTURE(spec);
    CHECK_FALSE(shape_of(spec).factorises);
  }
}

TEST_CASE("the scale of a Gaussian is constant, that of Student-T sqrt(1 + x^2 / k)") {
  CHECK(shape_of("beckmann").scale.quadratic == 0);
  CHECK(shape_of("ggx").scale.quadratic == Approx(1).epsilon(1e-9));
  const auto student = parse_distribution("student-t:gamma=4");
  const double mu = UnitSlopes(*student, {}).mean_slope();
  CHECK(shape_of("student-t:gamma=4").scale.quadratic == Approx(mu * mu / 3).epsilon(1e-8));
}
