// Splines that are exact where the samples are a spline, and stationary where they are not.
#include "vndf/distributions/least_squares_spline.h"

#include <cmath>
#include <vector>

#include "support/catch.h"

using namespace vndf::distributions;
using namespace vndf::test;

namespace {

struct Samples {
  std::vector<double> t, value, weight;

  double squares(const LeastSquaresSpline& fit) const {
    double sum = 0;
    for (std::size_t i = 0; i < t.size(); ++i) {
      sum += weight[i] * std::pow(fit.at(t[i]) - value[i], 2);
    }
    return sum;
  }
};

template <class F>
Samples samples_of(F f, int count) {
  Samples samples;
  for (int i = 0; i < count; ++i) {
    samples.t.push_back(std::pow(static_cast<double>(i) / (count - 1), 2));  // unequal steps
    samples.value.push_back(f(samples.t.back()));
    samples.weight.push_back(1 + i % 3);
  }
  return samples;
}

LeastSquaresSpline fit_of(const Samples& s, const std::vector<double>& knots) {
  return {{s.t, s.value, s.weight}, knots};
}

}  // namespace

TEST_CASE("a cubic is its own fit, whatever the knots and weights") {
  const auto cubic = [](double t) { return 1 + t * (2 + t * (-3 + t)); };
  const Samples samples = samples_of(cubic, 40);
  for (const std::vector<double>& knots :
       std::vector<std::vector<double>>{{0, 1}, {0, 0.5, 1}, {0, 0.01, 0.1, 0.4, 1}}) {
    const auto fit = fit_of(samples, knots);
    for (const double t : {0.0, 0.005, 0.3, 0.77, 1.0}) CHECK(fit.at(t) == Approx(cubic(t)));
  }
}

TEST_CASE("a truncated cubic is the fit where its knot is a knot, and only there") {
  const auto bent = [](double t) { return t > 0.5 ? std::pow(t - 0.5, 3) : 0; };
  const Samples samples = samples_of(bent, 200);
  CHECK(samples.squares(fit_of(samples, {0, 0.5, 1})) < 1e-24);
  CHECK(samples.squares(fit_of(samples, {0, 0.7, 1})) > 1e-6);
}

TEST_CASE("no cubic added to a fit makes the sum of squares smaller") {
  const Samples samples = samples_of([](double t) { return std::sin(20 * t); }, 300);
  const auto fit = fit_of(samples, {0, 0.2, 0.5, 1});
  // The residual is orthogonal to every cubic.
  for (const int power : {0, 1, 2, 3}) {
    double product = 0, size = 0;
    for (std::size_t i = 0; i < samples.t.size(); ++i) {
      const double term = samples.weight[i] * std::pow(samples.t[i], power);
      product += term * (fit.at(samples.t[i]) - samples.value[i]);
      size += term;
    }
    CHECK(std::abs(product) < 1e-10 * size);
  }
}
