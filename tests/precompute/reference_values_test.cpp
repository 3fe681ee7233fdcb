// The 40-digit reference values of tests/reference for the distributions that the toolkit knows.
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/built_tables.h"
#include "support/catch.h"
#include "vndf/distributions/families.h"
#include "vndf/distributions/parse_distribution.h"
#include "vndf/precompute/conditional_distribution.h"
#include "vndf/precompute/marginal_distribution.h"
#include "vndf/tabulated_sampler.h"

using namespace vndf;
using namespace vndf::distributions;
using namespace vndf::precompute;
using namespace vndf::test;

namespace {

struct Reference {
  double place, u, value;
};

/// How the reference file calls a distribution, and its specification here.
struct Named {
  std::string distribution, parameter, spec;
};

const std::vector<Named> kNamed{
    {"beckmann", "", "beckmann"},
    {"ggx", "", "ggx"},
    {"student_t", "gamma=2.5", "student-t:gamma=2.5"},
    {"student_t", "gamma=4", "student-t:gamma=4"},
    {"exp_power", "p=0.5", "exponential-power:p=0.5"},
    {"exp_power", "p=1", "exponential-power:p=1"},
    {"exp_power", "p=4", "exponential-power:p=4"},
    {"k_dist", "nu=1", "k:nu=1"},
    {"uniform_disk", "", "disk"},
    {"annulus", "inner=0.5", "annulus:inner=0.5"},
    {"volcano", "", "volcano"},
    {"mixture", "0.5*ggx(1)+0.5*beckmann(0.2)", "mixture:0.5*ggx+0.5*beckmann@0.2"}};

double number(const std::string& text) {
  return text.empty() ? 0 : std::stod(text);
}

std::vector<Reference> references(const Named& named, const std::string& quantity) {
  std::ifstream file(VNDF_REFERENCE_FILE);
  if (!file) throw std::runtime_error("cannot read " VNDF_REFERENCE_FILE);
  std::vector<Reference> list;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::istringstream fields(line);
    std::string name, param, what, place, u, value;
    for (auto* field : {&name, &param, &what, &place, &u, &value})
      std::getline(fields, *field, ',');
    if (name == named.distribution && param == named.parameter && what == quantity)
      list.push_back({number(place), number(u), number(value)});
  }
  return list;
}

struct Case {
  explicit Case(const Named& named)
      : distribution(parse_distribution(named.spec)),
        slopes(*distribution, {}),
        built(large_tables(named.spec)),
        sampler(built.tables) {}

  std::unique_ptr<SlopeDistribution> distribution;
  UnitSlopes slopes;
  const BuiltTables& built;
  TabulatedSampler<float> sampler;
};

}  // namespace

TEST_CASE("visible quantiles agree with the reference values within the certificate") {
  for (const Named& named : kNamed) {
    const Case s(named);
    const double bound = s.built.certificate.marginal.max_u_error;
    const auto list = references(named, "x_marginal");
    CHECK(list.size() == 25);
    for (const auto& r : list) {
      CAPTURE(named.spec, r.place, r.u);
      const double theta = r.place * std::numbers::pi / 180;
      const double mu = s.slopes.mean_slope();
      const MarginalDistribution visible(s.slopes,
                                         bounded_cotangent(std::cos(theta), mu * std::sin(theta)));
      // The exact CDF at the reference's slope, to the precision of the curves ...
      CHECK(visible.cdf(std::asinh(r.value / mu)).u == Approx(r.u).margin(1e-12));
      // ... and the sampler's slope through it.
      const Vec3<float> wi{static_cast<float>(std::sin(theta)), 0,
                           static_cast<float>(std::cos(theta))};
      const auto m = s.sampler.sample(wi, {1, 1}, static_cast<float>(r.u), 0.5f);
      const double x = std::asinh(-double{m.x} / m.z / mu);
      CHECK(std::abs(visible.cdf(std::min(x, visible.farthest())).u -
                     double{static_cast<float>(r.u)}) <= bound);
    }
  }
}

TEST_CASE("conditional quantiles agree with the reference values within the certificate") {
  for (const Named& named : kNamed) {
    const Case s(named);
    const double mu = s.slopes.mean_slope();
    const auto list = references(named, "y_conditional");
    CHECK(list.size() == 24);
    for (const auto& r : list) {
      CAPTURE(named.spec, r.place, r.u);
      const double x = std::abs(r.place) / mu;  // the conditional is that of |x|
      const SlopeTables& tables = *s.built.tables;
      const ConditionalScale<double> scale_of{tables.conditional_constant,
                                              tables.conditional_quadratic};
      const ConditionalDistribution conditional(s.slopes, x, scale_of);
      const double scale = mu * scale_of.at({x, 1});
      const auto cdf = [&](double y) {
        const double tail = conditional.cdf(std::abs(y) / scale).complement / 2;
        return y < 0 ? tail : 1 - tail;
      };
      CHECK(cdf(r.value) == Approx(r.u).margin(1e-12));
      const auto bounded = bounded_from_slope(static_cast<float>(x));
      const auto folded = fold(probability(static_cast<float>(r.u)));
      const float v = s.sampler.map().conditional(bounded, folded.p);
      const double y = double{folded.sign} * conditional_value_inverse(double{v}).slope() * scale;
      CHECK(std::abs(cdf(y) - double{static_cast<float>(r.u)}) <=
            s.built.certificate.conditional.max_u_error);
    }
  }
}

TEST_CASE("Lambda agrees with the reference values within the certificate") {
  for (const Named& named : kNamed) {
    const Case s(named);
    const auto list = references(named, "Lambda_at_cot");
    CHECK(list.size() == 4);
    for (const auto& r : list) {
      CAPTURE(named.spec, r.place);
      const double mu = s.slopes.mean_slope();
      CHECK(mu * s.slopes.backfacing(r.place / mu).value / r.place ==
            Approx(r.value).epsilon(1e-12));
      const double length = std::hypot(1, r.place);
      const Vec3<float> w{static_cast<float>(1 / length), 0, static_cast<float>(r.place / length)};
      // The direction itself is rounded to single precision; its cotangent is compared as given.
      const double rounding = 2e-7 * (1 + r.value);
      CHECK(std::abs(double{s.sampler.lambda(w, {1, 1})} - r.value) <=
            s.built.certificate.max_lambda_error * (1 + r.value) + rounding);
    }
  }
}
