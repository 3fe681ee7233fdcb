// The rank correlation follows order alone, and ties share ranks.
#include "vndf/validate/statistics/rank_correlation.h"

#include <cmath>
#include <vector>

#include "support/catch.h"

using namespace vndf::validate;

TEST_CASE("the rank correlation of what increases is 1 and of what decreases -1, however bent") {
  const std::vector<double> a{3, 1, 2, 5, 4};
  std::vector<double> b, c;
  for (const double v : a) {
    b.push_back(std::exp(10 * v));
    c.push_back(-v * v * v);
  }
  CHECK(rank_correlation(a, b) == Approx(1));
  CHECK(rank_correlation(a, c) == Approx(-1));
}

TEST_CASE("the rank correlation of few values is that of the textbook formula") {
  // 1 - 6 sum d^2 / (n (n^2 - 1)), where d^2 add up to 4 and to 8 (Spearman 1904).
  const std::vector<double> a{1, 2, 3, 4, 5}, b{2, 1, 3, 6, 4.5}, c{20, 10, 50, 30, 40};
  CHECK(rank_correlation(a, b) == Approx(1 - 6.0 * 4 / 120));
  CHECK(rank_correlation(a, c) == Approx(1 - 6.0 * 8 / 120));
}

TEST_CASE("equal values share the mean of their ranks, and a constant has no correlation") {
  // Ranks 0.5, 0.5, 2 against 0, 1, 2: covariance 1.5 / sqrt(1.5 * 2).
  const std::vector<double> a{7, 7, 9}, b{1, 2, 3}, c{4, 4, 4};
  CHECK(rank_correlation(a, b) == Approx(1.5 / std::sqrt(3.0)));
  CHECK(rank_correlation(a, c) == 0);
}
