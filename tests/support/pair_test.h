// Chi-square test of pairs of numbers that should be uniform over the unit square, both together:
// a dependence between the two slopes shows, too.
#pragma once

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cstdint>
#include <random>
#include <vector>

#include "support/visible_normals.h"

namespace vndf::test {

/// Primes, so that no bin is aligned with a symmetry of a method.
inline constexpr std::size_t kColumns = 31, kRows = 37;

class PairCounts {
 public:
  void add(const Vec2<double>& v) {
    const auto place = [](double t, std::size_t count) {
      const double scaled = t * static_cast<double>(count);
      return scaled > 0 ? std::min(static_cast<std::size_t>(scaled), count - 1) : std::size_t{0};
    };
    ++counts_[place(v.x, kColumns) * kRows + place(v.y, kRows)];
    ++total_;
  }

  /// p-value of the counts against `probabilities`, one for each bin; uniform where it is empty.
  double p_value(const std::vector<double>& probabilities = {}) const {
    double statistic = 0, degrees = -1;
    for (std::size_t k = 0; k < counts_.size(); ++k) {
      const double share =
          probabilities.empty() ? 1.0 / static_cast<double>(counts_.size()) : probabilities[k];
      const double expected = share * total_, excess = counts_[k] - expected;
      if (expected < kFewest) {
        // A bin in which next to nothing falls has no chi-square distribution, but must stay as
        // empty.
        if (counts_[k] > kFewest * 10) return 0;
        continue;
      }
      statistic += excess * excess / expected;
      ++degrees;
    }
    return cdf(complement(boost::math::chi_squared(degrees), statistic));
  }

 private:
  static constexpr double kFewest = 5;

  std::vector<double> counts_ = std::vector<double>(kColumns * kRows);
  double total_ = 0;
};

/// p-value of `count` normals of `sampler`, transformed by `distribution` to pairs.
template <class Distribution, class T, class Sampler>
double distribution_p_value(const Distribution& distribution, const Sampler& sampler,
                            const Vec3<T>& wi, const Alpha<T>& alpha,
                            const std::vector<double>& probabilities = {}, int count = 200000,
                            std::uint64_t seed = 1) {
  std::mt19937_64 random(seed);
  const auto uniform = [&] {
    return static_cast<T>(std::ldexp(static_cast<double>(random() >> 40) + 0.5, -24));
  };
  PairCounts counts;
  for (int k = 0; k < count; ++k) {
    const T u1 = uniform(), u2 = uniform();
    counts.add(distribution(sampler.sample(wi, alpha, u1, u2)));
  }
  return counts.p_value(probabilities);
}

/// The same against the exact distribution of visible slopes.
template <class Forms, class T, class Sampler>
double visible_p_value(const Sampler& sampler, const Vec3<T>& wi, const Alpha<T>& alpha) {
  return distribution_p_value(VisibleDistribution<Forms>(wi, alpha), sampler, wi, alpha);
}

}  // namespace vndf::test
