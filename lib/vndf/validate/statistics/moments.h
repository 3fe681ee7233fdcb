// Mean and variance of a stream of numbers in one pass, of any length. Sums of squares would lose
// their digits, so each number moves the mean by its share (Welford 1962), and two streams are
// joined by the same rule (Chan, Golub and LeVeque 1979).
#pragma once

#include <cmath>
#include <cstdint>

namespace vndf::validate {

/// The moments of the numbers added so far.
struct Moments {
  std::uint64_t count = 0;
  double mean = 0;
  double squares = 0;  ///< sum of squared deviations from the mean

  void add(double x) {
    ++count;
    const double deviation = x - mean;
    mean += deviation / static_cast<double>(count);
    squares += deviation * (x - mean);
  }

  /// As if all numbers of `other` had been added.
  void merge(const Moments& other) {
    if (other.count == 0) return;
    const auto n = static_cast<double>(count), m = static_cast<double>(other.count);
    const double deviation = other.mean - mean;
    count += other.count;
    mean += deviation * m / (n + m);
    squares += other.squares + deviation * deviation * n * m / (n + m);
  }

  /// Unbiased estimate of the variance of one number; 0 for fewer than two.
  double variance() const { return count > 1 ? squares / static_cast<double>(count - 1) : 0; }

  /// The standard error of the mean; 0 without numbers.
  double standard_error() const {
    return count > 0 ? std::sqrt(variance() / static_cast<double>(count)) : 0;
  }
};

}  // namespace vndf::validate
