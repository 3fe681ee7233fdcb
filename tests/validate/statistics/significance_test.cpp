// p-values are compared with values that are known otherwise, and with the frequencies of counts
// that are drawn.
#include "vndf/validate/statistics/significance.h"

#include <cmath>
#include <random>

#include "support/catch.h"

using namespace vndf::validate;
using vndf::test::Approx;

TEST_CASE("Sidak's bound makes the chance of any false rejection what was asked for") {
  const double each = sidak(1e-3, 500);
  CHECK(1 - std::pow(1 - each, 500) == Approx(1e-3).epsilon(1e-9));
  CHECK(sidak(0.01, 1) == Approx(0.01));
}

TEST_CASE("chi-square p-values: table values, and a declared error moves the mean") {
  CHECK(chi_square_p(18.307, 11, 1000, 0) == Approx(0.05).epsilon(1e-3));  // 10 degrees, 5 %
  CHECK(chi_square_p(1e300, 11, 1000, 0) == 0);
  // Mean k + lambda: half of the distribution is near it.
  CHECK(chi_square_p(10006 + 500, 10007, 5e6, 0.01) == Approx(0.5).margin(0.01));
  CHECK(chi_square_p(100 + 50, 101, 5e5, 0.01) == Approx(0.5).margin(0.03));
}

TEST_CASE("the approximation for many degrees of freedom joins the exact noncentral distribution") {
  // Just below and just above the switch, at the same number of standard deviations.
  for (const double z : {-2.0, 0.0, 2.0, 4.0}) {
    const auto p = [z](std::size_t bins) {
      const double k = static_cast<double>(bins - 1), lambda = 100;
      return chi_square_p(k + lambda + z * std::sqrt(2 * (k + 2 * lambda)), bins, 1e6, 0.01);
    };
    CHECK(p(9900) == Approx(p(9902)).epsilon(0.01));
  }
}

TEST_CASE("binomial p-values are two-sided and allow what is declared") {
  CHECK(binomial_p(50, 100, 0.5, 0) == 1);
  CHECK(binomial_p(0, 10, 0.5, 0) == Approx(2.0 / 1024));
  CHECK(binomial_p(10, 10, 0.5, 0) == Approx(2.0 / 1024));
  CHECK(binomial_p(1200, 100000, 0.01, 0) < 1e-8);
  CHECK(binomial_p(1200, 100000, 0.01, 0.2) > 0.5);
}

TEST_CASE("p-values of uniform counts are not smaller than they should be") {
  std::mt19937_64 random(7);
  constexpr int kRuns = 2000, kBins = 23, kSamples = 1000;
  int below = 0;
  for (int run = 0; run < kRuns; ++run) {
    double counts[kBins] = {}, statistic = 0;
    for (int k = 0; k < kSamples; ++k) counts[random() % kBins] += 1;
    for (const double c : counts) statistic += std::pow(c - kSamples / 23.0, 2) / (kSamples / 23.0);
    below += chi_square_p(statistic, kBins, kSamples, 0) < 0.05;
  }
  // Binomial, mean 100, standard deviation 9.7.
  CHECK(below > 60);
  CHECK(below < 140);
}

TEST_CASE("an error of the size that is said to be seen is seen") {
  const double p = 1e-8, n = 1e6;
  CHECK(cumulative_p(visible_u_error(n, p) / 2, n, 0) == Approx(p));
  CHECK(cumulative_p(visible_u_error(n, p) / 2, n, 1e-3) > p);
  const double e = visible_bin_error(n, 10007);
  CHECK(n * e * e == Approx(3 * std::sqrt(2 * 10007.0)));
}
