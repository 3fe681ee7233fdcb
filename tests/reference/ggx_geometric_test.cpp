// The two geometric constructions of visible GGX normals: the density of their maps, their
// distribution by chi-square, what float costs.
#include "support/catch.h"
#include "support/pair_test.h"
#include "support/tolerances.h"
#include "support/visible_normals.h"
#include "vndf/reference/ggx_caps.h"
#include "vndf/reference/ggx_hemisphere.h"

using namespace vndf;
using namespace vndf::test;

namespace {

const std::vector<Alpha<double>> kAlphas{{1, 1}, {0.3, 0.05}, {0.01, 3}};

template <template <class> class Sampler>
void check_jacobian(double bound) {
  for (const double degrees : {0.3, 10.0, 30.0, 60.0, 80.0, 89.0, 90.0})
    for (const Alpha<double>& alpha : kAlphas) {
      CAPTURE(degrees, alpha.x, alpha.y);
      CHECK(worst_jacobian_error(Sampler<double>(), direction_at<double>(degrees, 35), alpha) <=
            bound);
    }
}

template <template <class> class Sampler>
void check_float(double bound) {
  for (const double degrees : {0.0, 1e-5, 1.0, 60.0, 89.9, 90.0})
    for (const float alpha : {1.0f, 0.1f}) {
      CAPTURE(degrees, alpha);
      CHECK(rounding_error<GgxForms>(Sampler<float>(), Sampler<double>(),
                                     direction_at<float>(degrees, 20),
                                     Alpha<float>{alpha, alpha}) <= bound);
    }
}

template <template <class> class Sampler>
void check_distribution() {
  for (const double degrees : {0.0, 30.0, 75.0, 90.0})
    for (const Alpha<double>& alpha : kAlphas) {
      CAPTURE(degrees, alpha.x, alpha.y);
      CHECK(visible_p_value<GgxForms>(Sampler<double>(), direction_at<double>(degrees, 35), alpha) >
            kSignificance);
    }
}

}  // namespace

TEST_CASE("the density of the cap and hemisphere maps is the exact pdf") {
  check_jacobian<GgxCaps>(GgxCapsMethod::kJacobianError);
  check_jacobian<GgxHemisphere>(GgxHemisphereMethod::kJacobianError);
}

TEST_CASE("normals from caps and hemispheres pass a chi-square test of both slopes together") {
  check_distribution<GgxCaps>();
  check_distribution<GgxHemisphere>();
}

TEST_CASE("caps and hemispheres in float keep their stated errors") {
  check_float<GgxCaps>(GgxCapsMethod::kFloatError);
  check_float<GgxHemisphere>(GgxHemisphereMethod::kFloatError);
}
