// Which normal distributions are shape-invariant, and what the error for the others says.
#include "vndf/distributions/shape_invariance.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "support/catch.h"
#include "vndf/distributions/formula_distribution.h"

using namespace vndf::distributions;
using namespace vndf::test;

namespace {

/// Generalised Trowbridge-Reitz (Burley 2012), not normalised.
double gtr(double theta, double alpha, double gamma) {
  const double cosine = std::cos(theta);
  return std::pow(1 + (alpha * alpha - 1) * cosine * cosine, -gamma);
}

double phong(double theta, double alpha) {
  return std::pow(std::cos(theta), 2 / (alpha * alpha) - 2);
}

ShapeInvariance measured(const std::string& formula) {
  return measure_shape_invariance(NdfFormula({formula, {}}));
}

}  // namespace

TEST_CASE("Beckmann, GGX and their like are shape-invariant, normalised or not") {
  for (const char* formula : {"exp(-(tan(theta)/alpha)^2) / (pi * alpha^2 * cos(theta)^4)",
                              "exp(-(tan(theta)/alpha)^2) / cos(theta)^4",
                              "alpha^2 / (pi * cos(theta)^4 * (alpha^2 + tan(theta)^2)^2)",
                              "(1 + (tan(theta)/alpha)^2 / 0.6)^-1.6 / cos(theta)^4",
                              "exp(-sqrt(tan(theta)/alpha)) / cos(theta)^4",
                              "(tan(theta)/alpha)^2 * exp(-(tan(theta)/alpha)^2) / cos(theta)^4",
                              "(tan(theta) < alpha ? 1 : 0) / cos(theta)^4"}) {
    CAPTURE(formula, measured(formula).violation);
    CHECK(measured(formula).violation < 1e-10);
    CHECK_NOTHROW(require_shape_invariant(NdfFormula({formula, {}}), formula));
  }
  CHECK(measure_shape_invariance([](double t, double a) { return gtr(t, a, 2); }).violation <
        kShapeInvariant);
}

TEST_CASE("Blinn-Phong and GTR of other exponents are not") {
  CHECK(measure_shape_invariance(phong).violation > 0.5);
  for (const double gamma : {1.0, 1.5, 1.99, 2.01, 3.0}) {
    CAPTURE(gamma);
    const auto found =
        measure_shape_invariance([gamma](double t, double a) { return gtr(t, a, gamma); });
    CHECK(found.violation > 1e-3);
    CHECK(found.alpha != found.reference_alpha);
    CHECK(found.r > 0);
  }
}

TEST_CASE("the message says by how much, where, and what to do") {
  CHECK_THROWS_AS(require_shape_invariant(phong, "phong"), NotShapeInvariant);
  CHECK_THROWS_WITH(require_shape_invariant(phong, "phong"),
                    contains("'phong' is not shape-invariant: at a slope of ") &&
                        contains(" alpha, its normalised densities for alpha = ") &&
                        contains(" differ by ") &&
                        contains("the surface of one alpha can be taken as the shape"));
}

TEST_CASE("a D that is no density is refused") {
  CHECK_THROWS_WITH(measure_shape_invariance([](double, double) { return -1.0; }),
                    contains("D is -1 at theta = ") && contains("alpha = 0.05"));
  CHECK_THROWS_WITH(measure_shape_invariance([](double, double a) { return std::log(a - 0.1); }),
                    contains("D is nan at theta"));
  CHECK_THROWS_WITH(measure_shape_invariance([](double, double) { return 0.0; }),
                    contains("D is zero at every theta for alpha = 0.05"));
}
