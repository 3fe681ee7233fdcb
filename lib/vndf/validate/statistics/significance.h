// The probabilities behind verdicts on counts: p-values that allow for an error that a sampler
// declares, Sidak's correction for many tests, and the size of error that a number of samples can
// see.
#pragma once

#include <cstddef>
#include <cstdint>

namespace vndf::validate {

/// Probability that a correct sampler fails any of the statistical tests of one run.
inline constexpr double kRunSignificance = 1e-6;

/// The bound on each of `tests` independent p-values that a correct sampler breaks at least once
/// with probability `significance` (Sidak 1967); 0 for no tests.
double sidak(double significance, std::size_t tests);

/// The p-value of Pearson's statistic of `count` samples over `bins` bins, where the bins may
/// differ from what is expected by a relative error `declared` (root mean square): the tail of the
/// noncentral chi-square with noncentrality count declared^2 (Patnaik 1949). Valid where 5 or more
/// are expected in each bin. Of many bins it is an approximation, to 1e-3 of the p-value.
double chi_square_p(double statistic, std::size_t bins, double count, double declared);

/// The two-sided p-value, at most 1, of `seen` of `count` samples in a bin whose probability is
/// `expected` times a factor that is unknown within [1 / (1 + declared), 1 + declared]: exact
/// binomial.
double binomial_p(std::uint64_t seen, std::uint64_t count, double expected, double declared);

/// The p-value of a largest distance `distance` between a CDF and the empirical one of `count`
/// samples, of which `declared` is allowed: Massart's bound 2 exp(-2 n d^2) (1990), which is never
/// too small.
double cumulative_p(double distance, double count, double declared);

/// The error in u that `count` samples show with near certainty at significance `p`: the distance
/// at which cumulative_p() is p, and as much again for the noise of the sample.
double visible_u_error(double count, double p);

/// The relative error (root mean square over `bins` bins) that Pearson's statistic shows. It moves
/// the statistic by n e^2, which is to be three of its standard deviations sqrt(2 bins).
double visible_bin_error(double count, std::size_t bins);

}  // namespace vndf::validate
