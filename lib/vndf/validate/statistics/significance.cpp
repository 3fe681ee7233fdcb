// The probabilities behind verdicts on counts.
#include "vndf/validate/statistics/significance.h"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/non_central_chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>

namespace vndf::validate {
namespace {

// Beyond this many degrees of freedom and noncentrality the noncentral distribution is normal in
// the cube root to 1e-3 of its p-value (Sankaran 1959), and its series is long.
constexpr double kLongSeries = 1e4;

/// The upper tail of the noncentral chi-square by Sankaran's approximation.
double noncentral_tail(double x, double k, double lambda) {
  const double h = 1 - 2 * (k + lambda) * (k + 3 * lambda) / (3 * std::pow(k + 2 * lambda, 2));
  const double p = (k + 2 * lambda) / std::pow(k + lambda, 2);
  const double m = (h - 1) * (1 - 3 * h);
  const double z = (std::pow(x / (k + lambda), h) - (1 + h * p * (h - 1 - (2 - h) * m * p / 2))) /
                   (h * std::sqrt(2 * p) * (1 + m * p / 2));
  return boost::math::cdf(boost::math::complement(boost::math::normal(), z));
}

}  // namespace

double sidak(double significance, std::size_t tests) {
  if (tests == 0) return 0;
  return -std::expm1(std::log1p(-significance) / static_cast<double>(tests));
}

double chi_square_p(double statistic, std::size_t bins, double count, double declared) {
  const double freedom = static_cast<double>(bins - 1);
  const double lambda = count * declared * declared;
  if (std::isinf(statistic)) return 0;
  if (lambda == 0) return cdf(complement(boost::math::chi_squared(freedom), statistic));
  if (freedom + lambda > kLongSeries) return noncentral_tail(statistic, freedom, lambda);
  return cdf(complement(boost::math::non_central_chi_squared(freedom, lambda), statistic));
}

double binomial_p(std::uint64_t seen, std::uint64_t count, double expected, double declared) {
  const auto n = static_cast<double>(count), k = static_cast<double>(seen);
  const auto in_bin = [&](double factor) {
    return boost::math::binomial(n, std::clamp(expected * factor, 0.0, 1.0));
  };
  // Too few are checked by the smallest probability that is declared, too many by the largest.
  const double few = cdf(in_bin(1 / (1 + declared)), k);
  const double many = seen == 0 ? 1 : cdf(complement(in_bin(1 + declared), k - 1));
  return std::min(1.0, 2 * std::min(few, many));
}

double cumulative_p(double distance, double count, double declared) {
  const double beyond = std::max(0.0, distance - declared);
  return std::min(1.0, 2 * std::exp(-2 * count * beyond * beyond));
}

double visible_u_error(double count, double p) {
  return 2 * std::sqrt(std::log(2 / p) / (2 * count));
}

double visible_bin_error(double count, std::size_t bins) {
  return std::sqrt(3 * std::sqrt(2 * static_cast<double>(bins)) / count);
}

}  // namespace vndf::validate
