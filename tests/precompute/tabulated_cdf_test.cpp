// A tabulated CDF against one in closed form: exp(-x) up to 30 and what is declared beyond.
#include "vndf/precompute/tabulated_cdf.h"

#include <cmath>
#include <limits>

#include "support/catch.h"

using namespace vndf;
using namespace vndf::precompute;
using vndf::test::Approx;

namespace {

constexpr double kNoGuess = std::numeric_limits<double>::quiet_NaN();
constexpr double kEnd = 30, kPanel = 0.25;

struct Exponential {
  double operator()(double x) const { return std::exp(-x); }
};

std::vector<double> edges() {
  std::vector<double> places;
  for (int k = 0; k * kPanel <= kEnd; ++k) places.push_back(k * kPanel);
  return places;
}

TabulatedCdf<Exponential> exponential() {
  std::vector<distributions::Estimate> panels;
  for (const double x : edges())
    if (x < kEnd) panels.push_back({std::exp(-x) * -std::expm1(-kPanel), 1e-20});
  return {Exponential{}, edges(), panels, {std::exp(-kEnd), 1e-20}};
}

}  // namespace

TEST_CASE("a tabulated CDF keeps its relative precision in both tails") {
  const auto cdf = exponential();
  CHECK(cdf.above_first() == Approx(1).epsilon(1e-14));
  CHECK(cdf.error() == Approx(121e-20).epsilon(1e-12));
  for (const double x : {0.0, 1e-12, 1e-3, 0.3, 0.7, 3.0, 20.0, 29.9}) {
    CAPTURE(x);
    CHECK(cdf.cdf(x).u == Approx(-std::expm1(-x)).epsilon(1e-13));
    CHECK(cdf.cdf(x).complement == Approx(std::exp(-x)).epsilon(1e-13));
  }
}

TEST_CASE("all that lies beyond the last edge lies above every place there") {
  const auto cdf = exponential();
  for (const double x : {kEnd, 31.0, std::numeric_limits<double>::infinity()})
    CHECK(cdf.cdf(x).complement == Approx(std::exp(-kEnd)).epsilon(1e-13));
}

TEST_CASE("the inverses of a tabulated CDF count from either end, whatever the guess") {
  const auto cdf = exponential();
  for (const double e : {1e-12, 1e-6, 0.1, 0.5, 0.9})
    for (const double guess : {kNoGuess, -1.0, 0.1, 100.0}) {
      CAPTURE(e, guess);
      for (const Rounding order : {Rounding::sum, Rounding::difference})
        CHECK(cdf.inverse_below(e, guess, order) == Approx(-std::log1p(-e)).epsilon(1e-12));
      CHECK(cdf.inverse_above(e, guess) == Approx(-std::log(e)).epsilon(1e-13));
    }
}

TEST_CASE("interpolation of a tabulated CDF is good to 3e-4 of a panel") {
  const auto cdf = exponential();
  for (const double x : {0.1, 0.7, 5.3, 29.8})
    CHECK(std::abs(cdf.interpolated_inverse_above(std::exp(-x)) - x) < 3e-4 * kPanel);
}

TEST_CASE("a density without given integrals is integrated panel by panel") {
  const TabulatedCdf<Exponential> cdf(Exponential{}, edges());
  CHECK(cdf.below_last() == Approx(-std::expm1(-kEnd)).epsilon(1e-14));
  CHECK(cdf.above_first() == Approx(cdf.below_last()).epsilon(1e-15));
  CHECK(cdf.error() == 0);
}
