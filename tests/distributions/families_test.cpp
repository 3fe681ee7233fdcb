// Every named family: closed forms against quadrature, normalisation, identities between families,
// ranges of parameters.
#include "vndf/distributions/families.h"

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/catch.h"
#include "support/tolerances.h"
#include "vndf/distributions/family_list.h"
#include "vndf/distributions/mixture.h"
#include "vndf/distributions/parse_distribution.h"
#include "vndf/distributions/slope_integrals.h"

using namespace vndf::distributions;
using namespace vndf::test;

namespace {

constexpr double kRounding = 2e-14;

bool close(double value, double exact, double tolerance) {
  return std::abs(value - exact) <= tolerance * std::abs(exact);
}

void check_marginals(const SlopeDistribution& d, double x) {
  CAPTURE(d.name(), x);
  const auto exact = d.marginals(x);
  REQUIRE(exact.has_value());
  CHECK(close(marginal_density(d, x).value, exact->p, kIntegralError));
  CHECK(close(upper_tail(d, x).value, exact->q, kIntegralError));
  CHECK(close(partial_moment(d, x).value, exact->m, kIntegralError));
}

/// `a` equals `b` with slopes multiplied by `scale`.
void check_rescaled(const SlopeDistribution& a, const SlopeDistribution& b, double scale,
                    double tolerance = kRounding) {
  for (const double x : {0.0, 1e-6, 0.02, 0.3, 1.0, 2.5, 7.0}) {
    CAPTURE(a.name(), b.name(), x);
    CHECK(close(a.p22(x), b.p22(x / scale) / (scale * scale), tolerance));
    const auto in_a = a.marginals(x), in_b = b.marginals(x / scale);
    if (!in_a || !in_b) continue;
    CHECK(close(in_a->p, in_b->p / scale, tolerance));
    CHECK(close(in_a->q, in_b->q, tolerance));
    CHECK(close(in_a->m, in_b->m * scale, tolerance));
  }
}

std::unique_ptr<SlopeDistribution> parsed(const std::string& spec) {
  return parse_distribution(spec);
}

}  // namespace

TEST_CASE("closed forms of unbounded families equal the quadratures") {
  for (const char* spec :
       {"beckmann", "ggx", "student-t:gamma=1.6", "student-t:gamma=2.5", "student-t:gamma=20",
        "hyper-cauchy:q=1.75", "blinn-phong:n=0", "blinn-phong:n=50", "exponential-power:p=2",
        "k:nu=3", "volcano", "mixture:0.7*ggx+0.3*beckmann@0.2"}) {
    for (const double x : {0.0, 1e-3, 0.1, 0.9, 1.1, 2.0, 4.0}) check_marginals(*parsed(spec), x);
  }
  for (const double x : {1e-3, 0.1, 1.0, 5.0}) check_marginals(KDistribution(1), x);
}

TEST_CASE("closed forms of heavy tails equal the quadratures far out") {
  for (const char* spec : {"ggx", "student-t:gamma=1.6", "student-t:gamma=4", "hyper-cauchy"})
    for (const double x : {30.0, 1e4, 1e9, 1e15}) check_marginals(*parsed(spec), x);
}

TEST_CASE("closed forms of compact families equal the quadratures") {
  for (const char* spec : {"disk", "pearson-ii:m=1", "pearson-ii:m=2.5", "annulus:inner=0",
                           "annulus:inner=0.5", "annulus:inner=0.9"}) {
    for (const double x : {0.0, 1e-3, 0.1, 0.3, 0.49, 0.51, 0.7, 0.89, 0.95})
      check_marginals(*parsed(spec), x);
    for (const double x : {1.0, 2.0}) {
      const auto outside = parsed(spec)->marginals(x);
      CHECK((outside->p == 0 && outside->q == 0 && outside->m == 0));
    }
  }
}

TEST_CASE("a thin ring keeps its precision, where the difference of two disks has lost it") {
  // A circle of radius 1: P = 1 / (pi sqrt(1 - x^2)), Q = acos(x) / pi, M = sqrt(1 - x^2) / pi.
  const Annulus ring(1 - 1e-13);
  for (const double x : {0.1, 0.6, 0.8}) {
    const auto marginals = ring.marginals(x);
    const double chord = std::sqrt(1 - x * x);
    CHECK(close(marginals->p, std::numbers::inv_pi / chord, 1e-12));
    CHECK(close(marginals->q, std::acos(x) * std::numbers::inv_pi, 1e-12));
    CHECK(close(marginals->m, chord * std::numbers::inv_pi, 1e-12));
  }
}

TEST_CASE("closed forms against 40-digit values in the tails") {
  const auto check = [](const SlopeDistribution& d, double x, const Marginals& exact) {
    CAPTURE(d.name());
    const auto value = d.marginals(x);
    CHECK(close(value->p, exact.p, kRounding));
    CHECK(close(value->q, exact.q, kRounding));
    CHECK(close(value->m, exact.m, kRounding));
  };
  check(Beckmann(), 20,
        {1.08051873719339923e-174, 2.69793280580395046e-176, 5.40259368596699615e-175});
  check(StudentT(1.75), 100,
        {3.36292812886655165e-6, 2.24207218884932484e-4, 0.0672636069695243328});
  check(KDistribution(3), 10,
        {2.55457404538048506e-13, 7.79356249921538417e-14, 8.03096864405960926e-13});
  check(Volcano(), 15, {2.44519321280416864e-96, 8.16863663207345994e-98, 1.22801832084289179e-96});
}

TEST_CASE("densities against 40-digit values") {
  CHECK(close(KDistribution(0.3).p22(2), 0.00593623548522229786, kRounding));
  CHECK(close(KDistribution(10).p22(2), 0.00631111452095623328, kRounding));
  CHECK(close(ExponentialPower(0.5).p22(2), 0.00322443583613039949, kRounding));
}

TEST_CASE("every family of the list is normalised and says its name") {
  for (const auto& family : families()) {
    CAPTURE(family.name);
    CHECK(!family.density.empty());
    CHECK(!family.source.empty());
    if (!family.make) continue;
    const auto d = parsed(family.name);
    CHECK(d->name().rfind(family.name, 0) == 0);
    CHECK(close(slope_mass(*d).value, 1, kIntegralError));
    CHECK(std::isfinite(d->p22(0)) == (family.name != "k"));
    for (const auto& parameter : family.accepts)
      CHECK(family.parameters.find(parameter.name + "=") == 0);
  }
}

TEST_CASE("other members are normalised too") {
  for (const char* spec :
       {"student-t:gamma=1.55", "exponential-power:p=0.5", "exponential-power:p=8", "k:nu=0.5",
        "k:nu=1.5", "k:nu=3", "k:nu=7.25", "k:nu=100", "annulus:inner=0.99",
        "mixture:2*student-t:gamma=3@0.5+1*disk@2+1*k:nu=2@0.1"})
    CHECK(close(slope_mass(*parsed(spec)).value, 1, kIntegralError));
  // Infinite towards the edge: the quadrature, not the density, loses half of the digits.
  CHECK(close(slope_mass(PearsonII(-0.5)).value, 1, 1e-6));
}

TEST_CASE("families that are one distribution by two names") {
  check_rescaled(StudentT(2), Ggx(), 1);
  check_rescaled(ExponentialPower(2), Beckmann(), 1);
  check_rescaled(StudentT(1e9), Beckmann(), 1, 2e-6);
  check_rescaled(PearsonII(0), UniformDisk(), 1);
  check_rescaled(Annulus(0), UniformDisk(), 1);
  for (const double q : {1.6, 1.75, 2.0, 9.0})
    check_rescaled(HyperCauchy(q), StudentT(q), std::sqrt(2 / (q - 1)));
  for (const double n : {-0.5, 0.0, 10.0, 50.0})
    check_rescaled(BlinnPhong(n), StudentT((n + 4) / 2), std::sqrt(2 / (n + 2)), 1e-13);
}

TEST_CASE("Blinn-Phong is D cos^4 at r = tan(theta)") {
  for (const double theta : {0.0, 0.3, 1.0}) {
    const double d = 52 / (2 * std::numbers::pi) * std::pow(std::cos(theta), 54);
    CHECK(close(BlinnPhong(50).p22(std::tan(theta)), d, 1e-13));
  }
}

TEST_CASE("a mixture of one is its component, stretched") {
  const auto ggx = std::make_shared<Ggx>();
  check_rescaled(Mixture({{7, ggx, 1}}), Ggx(), 1);
  check_rescaled(Mixture({{0.1, ggx, 0.25}}), Ggx(), 0.25);
}

TEST_CASE("a mixture has the breaks of all components and marginals where all have them") {
  const auto mixture = parsed("mixture:1*disk@0.5+1*annulus:inner=0.5+2*disk@3");
  CHECK(mixture->breaks() == std::vector<double>{0.5, 1, 3});
  CHECK(mixture->support() == 3);
  CHECK(mixture->marginals(0.1).has_value());
  CHECK_FALSE(mixture->costly());
  const auto unbounded = parsed("mixture:1*disk+1*exponential-power");
  CHECK(std::isinf(unbounded->support()));
  CHECK_FALSE(unbounded->marginals(0.1).has_value());
  CHECK_FALSE(parsed("mixture:1*disk+1*k")->costly());
  CHECK(parsed("mixture:1*disk+1*k:nu=4")->costly());
}

TEST_CASE("breaks and support of compact families") {
  CHECK(UniformDisk().breaks() == std::vector<double>{1});
  CHECK(Annulus(0.25).breaks() == std::vector<double>{0.25, 1});
  CHECK(Annulus(0).breaks() == std::vector<double>{1});
  CHECK(PearsonII(1).support() == 1);
  CHECK(PearsonII(1).p22(1) == 0);
  CHECK(Annulus(0.25).p22(0.1) == 0);
}

TEST_CASE("K is singular at r = 0 for nu <= 1 only, and finite elsewhere") {
  for (const double nu : {0.01, 0.5, 1.0}) {
    CHECK(std::isinf(KDistribution(nu).p22(0)));
    for (const double r : {1e-300, 1e-200, 1e-20, 1.0, 1e3, 1e300})
      CHECK(std::isfinite(KDistribution(nu).p22(r)));
  }
  for (const double nu : {1.01, 2.0, 2.5, 3.5, 60.0}) {
    const double top = nu / (std::numbers::pi * (nu - 1));
    CHECK(close(KDistribution(nu).p22(0), top, kRounding));
    if (nu >= 2) CHECK(close(KDistribution(nu).p22(1e-9), top, kRounding));
  }
  // K of half an odd order is elementary; the second goes through the recurrence.
  const double z = 2 * std::sqrt(2.5) * 0.7;
  const double elementary = 2 * 2.5 * std::numbers::inv_pi / std::tgamma(2.5) *
                            std::pow(z / 2, 1.5) * std::sqrt(std::numbers::pi / (2 * z)) *
                            std::exp(-z) * (1 + 1 / z);
  CHECK(close(KDistribution(2.5).p22(0.7), elementary, kRounding));
  const double w = 2 * std::sqrt(3.5) * 0.7;
  const double next = 2 * 3.5 * std::numbers::inv_pi / std::tgamma(3.5) * std::pow(w / 2, 2.5) *
                      std::sqrt(std::numbers::pi / (2 * w)) * std::exp(-w) *
                      (1 + 3 / w + 3 / (w * w));
  CHECK(close(KDistribution(3.5).p22(0.7), next, kRounding));
}

TEST_CASE("nothing overflows into a number that is none") {
  for (const auto& family : families()) {
    if (!family.make) continue;
    const auto d = parsed(family.name);
    for (const double r : {1e-300, 1e100, 1e300}) {
      CAPTURE(d->name(), r);
      CHECK((d->p22(r) >= 0 && std::isfinite(d->p22(r))));
      const auto m = d->marginals(r);
      if (m) CHECK((m->p >= 0 && m->q >= 0 && m->m >= 0 && m->q <= 0.5));
    }
  }
}

TEST_CASE("parameters out of range are refused by name, rule and value") {
  CHECK_THROWS_WITH(StudentT(1.5), contains("student-t: gamma is 1.5; it must be > 3/2") &&
                                       contains("no masking function"));
  CHECK_THROWS_WITH(HyperCauchy(1), contains("hyper-cauchy: q is 1; it must be > 3/2"));
  CHECK_THROWS_WITH(BlinnPhong(-1), contains("blinn-phong: n is -1; it must be > -1"));
  CHECK_THROWS_WITH(ExponentialPower(0), contains("exponential-power: p is 0; it must be > 0"));
  CHECK_THROWS_WITH(KDistribution(0), contains("k: nu is 0; it must be > 0 and <= 100"));
  CHECK_THROWS_WITH(KDistribution(101), contains("k: nu is 101") && contains("Beckmann"));
  CHECK_THROWS_WITH(PearsonII(-1), contains("pearson-ii: m is -1; it must be >= -1/2"));
  CHECK_THROWS_WITH(Annulus(1), contains("annulus: inner is 1; it must be >= 0 and < 1"));
  CHECK_THROWS_WITH(Annulus(-0.1), contains("annulus: inner is -0.1"));
  const double infinity = std::numeric_limits<double>::infinity();
  CHECK_THROWS_AS(StudentT(infinity), std::invalid_argument);
  CHECK_THROWS_AS(StudentT(std::nan("")), std::invalid_argument);
  CHECK_THROWS_AS(ExponentialPower(std::nan("")), std::invalid_argument);
}

TEST_CASE("mixtures without a sense are refused") {
  const auto ggx = std::make_shared<Ggx>();
  CHECK_THROWS_WITH(Mixture({}), contains("mixture: it has no components"));
  CHECK_THROWS_WITH(Mixture({{1, nullptr, 1}}), contains("component 1 has no distribution"));
  CHECK_THROWS_WITH(Mixture({{1, ggx, 1}, {0, ggx, 1}}),
                    contains("the weight of component 2 is 0; it must be a finite number > 0"));
  CHECK_THROWS_WITH(Mixture({{1, ggx, -2}}), contains("the roughness of component 1 is -2"));
}
