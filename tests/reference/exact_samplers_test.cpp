// The referees: their maps against the closed CDFs, their tails against long double precision and
// quadrature, the 40-digit reference values.
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "support/catch.h"
#include "support/visible_normals.h"
#include "vndf/reference/beckmann_exact.h"
#include "vndf/reference/ggx_exact.h"

using namespace vndf;
using namespace vndf::test;

namespace {

using Long = long double;

const std::vector<double> kDegrees{0,  1e-5, 0.1, 0.2563, 1,  5,    20,     30,         45,
                                   60, 75,   85,  88,     89, 89.9, 89.999, 89.9999999, 90};

/// u from 1e-12 to 1 - 1e-12.
std::vector<double> tail_numbers() {
  std::vector<double> list;
  for (double e = 1e-12; e < 0.5; e *= 1.7) {
    list.push_back(e);
    list.push_back(1 - e);
  }
  return list;
}

template <class T>
Incidence<T> incidence(double degrees) {
  const auto w = direction_at<T>(degrees);
  return {w.z, w.x};
}

template <class Forms, template <class> class Sampler>
void check_maps() {
  DistributionErrors in_double, in_float;
  for (const double degrees : kDegrees) {
    const auto d = map_errors<Forms, double>(Sampler<double>(), direction_at<double>(degrees),
                                             Alpha<double>{1, 1});
    const auto f = map_errors<Forms, float>(Sampler<float>(), direction_at<float>(degrees),
                                            Alpha<float>{1, 1});
    take_larger(in_double, d.x, d.y);
    take_larger(in_float, f.x, f.y);
  }
  CAPTURE(in_double.x, in_double.y, in_float.x, in_float.y);
  CHECK(in_double.x <= GgxExactMethod::kDoubleError);
  CHECK(in_double.y <= GgxExactMethod::kDoubleError);
  CHECK(in_float.x <= GgxExactMethod::kFloatError);
  CHECK(in_float.y <= GgxExactMethod::kFloatError);
}

template <template <class> class Sampler>
void check_monotone() {
  // The slope of a normal that was rounded, relative.
  constexpr double kRounding = 1e-14;
  const Sampler<double> sampler;
  for (const double degrees : kDegrees) {
    const auto wi = direction_at<double>(degrees);
    double last_x = -INFINITY, last_y = -INFINITY;
    for (int k = -300; k <= 300; ++k) {
      const double tail = std::pow(10, -12.0 * std::abs(k) / 300) / 2;
      const double u = k > 0 ? 1 - tail : tail;
      const double x = slope_of(sampler.sample(wi, {1, 1}, u, 0.4)).x;
      const double y = slope_of(sampler.sample(wi, {1, 1}, 0.4, u)).y;
      CAPTURE(degrees, u, x, y);
      REQUIRE(x >= last_x - kRounding * std::abs(x));
      REQUIRE(y >= last_y - kRounding * std::abs(y));
      last_x = x;
      last_y = y;
    }
  }
}

/// N V(x) and N (1 - V(x)) for Beckmann.
Long lower_mass(const Incidence<double>& wi, Long x) {
  return wi.cos * std::erfc(-x) / 2 +
         wi.sin * std::exp(-x * x) * std::numbers::inv_sqrtpi_v<Long> / 2;
}
Long upper_mass(const Incidence<double>& wi, Long x) {
  // From the edge inwards: s = c - x, of which exp(-c^2) is a common factor.
  const Long c = Long{wi.cos} / wi.sin;
  const auto f = [c](Long s) { return s * std::exp(-(c - s) * (c - s)); };
  Long sum = 0;
  constexpr int kPieces = 16;
  const Long width = std::min(c - x, 8 - x) / kPieces, from = std::max(Long{0}, c - 8);
  for (int k = 0; k < kPieces; ++k)
    sum += boost::math::quadrature::gauss_kronrod<Long, 31>::integrate(f, from + k * width,
                                                                       from + (k + 1) * width, 0);
  return wi.sin * sum * std::numbers::inv_sqrtpi_v<Long>;
}

struct Reference {
  double place, u, value;
};

std::vector<Reference> references(const std::string& distribution, const std::string& quantity) {
  std::ifstream file(VNDF_REFERENCE_FILE);
  if (!file) throw std::runtime_error("cannot read " VNDF_REFERENCE_FILE);
  std::vector<Reference> list;
  for (std::string line; std::getline(file, line);) {
    std::istringstream fields(line);
    std::string name, parameter, what, place, u, value;
    for (auto* field : {&name, &parameter, &what, &place, &u, &value})
      std::getline(fields, *field, ',');
    if (name == distribution && what == quantity)
      list.push_back({std::stod(place), std::stod(u), std::stod(value)});
  }
  return list;
}

/// The slope of a reference value, relative: a few roundings of u, of theta and of the slope.
constexpr double kReferenceError = 1e-13;

/// Above the middle a decimal u such as 0.999999 is not a double, and its rounding moves the slope:
/// there the two slopes are compared in probability.
void check_reference(const Reference& r, double slope, double cdf, double reference_cdf) {
  CAPTURE(r.place, r.u, slope, r.value);
  if (r.u <= 0.5)
    CHECK(slope == Approx(r.value).epsilon(kReferenceError).margin(kReferenceError));
  else
    CHECK(std::abs(cdf - reference_cdf) <= GgxExactMethod::kDoubleError);
}

template <class Forms, template <class> class Sampler>
void check_references() {
  const Sampler<double> sampler;
  const auto marginals = references(Forms::name, "x_marginal");
  const auto conditionals = references(Forms::name, "y_conditional");
  REQUIRE(marginals.size() == 25);
  REQUIRE(conditionals.size() == 24);
  for (const Reference& r : marginals) {
    const auto wi = direction_at<double>(r.place);
    const double x = slope_of(sampler.sample(wi, {1, 1}, r.u, 0.5)).x;
    const auto cdf = [&](double at) { return visible_cdf<Forms>(wi.z, wi.x, at); };
    check_reference(r, x, cdf(x), cdf(r.value));
  }
  for (const Reference& r : conditionals) {
    // At normal incidence every slope is visible alike, and u1 = F(x) gives the slope of the file.
    const double u1 = r.place > 0 ? 1 - Forms::q(r.place) : Forms::q(-r.place);
    if (u1 == 1) continue;  // x = 10 is beyond what a u1 below 1 can give for Beckmann
    const Vec2<double> s = slope_of(sampler.sample({0, 0, 1}, {1, 1}, u1, r.u));
    check_reference(r, s.y, Forms::conditional(s.x, s.y), Forms::conditional(r.place, r.value));
  }
}

}  // namespace

TEST_CASE("the exact maps give the quantiles of u1 and u2 with their stated errors") {
  static_assert(GgxExactMethod::kDoubleError == BeckmannExactMethod::kDoubleError);
  static_assert(GgxExactMethod::kFloatError == BeckmannExactMethod::kFloatError);
  check_maps<GgxForms, GgxExact>();
  check_maps<BeckmannForms, BeckmannExact>();
}

TEST_CASE("the exact maps are monotone into both tails") {
  check_monotone<GgxExact>();
  check_monotone<BeckmannExact>();
}

TEST_CASE("the exact maps reproduce the 40-digit reference values") {
  check_references<GgxForms, GgxExact>();
  check_references<BeckmannForms, BeckmannExact>();
}

TEST_CASE("the lower and the upper mass of visible Beckmann slopes keep 12 digits") {
  double worst_lower = 0, worst_upper = 0;
  for (const double degrees : {1.0, 5.0, 11.0, 20.0, 30.0, 45.0, 60.0, 75.0, 85.0, 89.0, 89.99}) {
    const auto wi = incidence<double>(degrees);
    const VisibleBeckmannSlopes slopes(wi);
    const Long norm = lower_mass(wi, Long{wi.cos} / wi.sin);
    for (const double u : tail_numbers()) {
      const double x = slopes.quantile({u, 1 - u});
      const Long lower = lower_mass(wi, x) / norm, upper = upper_mass(wi, x) / norm;
      // The numbers themselves are off by the rounding of x; what is asked is the function.
      worst_lower =
          std::max(worst_lower, static_cast<double>(std::abs(slopes.lower(x) / lower - 1)));
      worst_upper =
          std::max(worst_upper, static_cast<double>(std::abs(slopes.upper(x) / upper - 1)));
    }
  }
  CAPTURE(worst_lower, worst_upper);
  CHECK(worst_lower <= VisibleBeckmannSlopes::kTailError);
  CHECK(worst_upper <= VisibleBeckmannSlopes::kTailError);
}

TEST_CASE("beyond a sampled lower slope lies the mass u to 12 digits") {
  double beckmann = 0, ggx = 0, conditional = 0;
  for (const double degrees : kDegrees) {
    const auto wi = incidence<double>(degrees);
    for (double u = 1e-12; u < 0.3; u *= 1.7) {
      if (degrees < 90) {
        const VisibleBeckmannSlopes slopes(wi);
        const Long norm = lower_mass(wi, Long{wi.cos} / wi.sin);
        const Long mass = lower_mass(wi, slopes.quantile({u, 1 - u})) / norm;
        beckmann = std::max(beckmann, static_cast<double>(std::abs(mass / u - 1)));
      }
      const SlopeAngle angle = visible_ggx_angle(wi, {u, 1 - u});
      const double x = angle.sin / angle.cos;
      if (x >= 0) continue;
      const double mass = (wi.cos * GgxForms::q(-x) + wi.sin * GgxForms::m(x)) / ((1 + wi.cos) / 2);
      ggx = std::max(ggx, std::abs(mass / u - 1));
    }
  }
  for (double q = 1e-12; q <= 0.5; q *= 1.7) {
    // P(|Z| > 1 / t) = 2 / pi (atan(t) - t / (1 + t^2)), and its series where that cancels
    const Long t = conditional_ggx_tail(q), square = t * t;
    const Long difference =
        t < 5e-3L ? 2 * t * square / 3 * (1 - 6 * square / 5 + 9 * square * square / 7)
                  : std::atan(t) - t / (1 + square);
    const Long mass = 2 * std::numbers::inv_pi_v<Long> * difference;
    conditional = std::max(conditional, static_cast<double>(std::abs(mass / q - 1)));
  }
  CAPTURE(beckmann, ggx, conditional);
  CHECK(beckmann <= VisibleBeckmannSlopes::kTailError);
  CHECK(ggx <= GgxExactMethod::kTailError);
  CHECK(conditional <= GgxExactMethod::kTailError);
}

TEST_CASE("the density of the exact maps is their pdf") {
  constexpr double kDifferenceError = 1e-6;
  for (const double degrees : {0.3, 30.0, 80.0, 90.0})
    for (const Alpha<double>& alpha : {Alpha<double>{1, 1}, {0.3, 0.05}, {0.01, 3}}) {
      const auto wi = direction_at<double>(degrees, 35);
      CAPTURE(degrees, alpha.x, alpha.y);
      CHECK(worst_jacobian_error(GgxExact<double>(), wi, alpha) <= kDifferenceError);
      CHECK(worst_jacobian_error(BeckmannExact<double>(), wi, alpha) <= kDifferenceError);
    }
}
