// The probabilities behind verdicts on counts: p-values that allow for an error that a sampler
// declares, Sidak's correction for many tests, and the size of error that a number of samples can
// see.
#pragma once

#include <cstddef>
#include <cstdint>

namespace vndf::validate {

/// Probability that a correct sampler fails any of the statistical tests of one run.
inline constexpr double kRunSignificance = 1e-6;

/// Sidak (1967): the bound on each of `tests` independent p-values that a correct sampler breaks at
/// least once with probability `significance`.
double sidak(double significance, std::size_t tests);

/// p-value of Pearson's statistic of `count` samples over `bins` bins, for a distribution whose
/// bins differ from the expected ones by a declared relative error `declared` (root mean square) at
/// most: the noncentral chi-square with noncentrality count declared^2 (Patnaik 1949). Valid: an
/// expected count of 5 or more in each bin.
double chi_square_p(double statistic, std::size_t bins, double count, double declared);

/// Two-sided p-value of `seen` of `count` samples in a bin whose probability is `expected` times a
/// factor that is unknown within [1 / (1 + declared), 1 + declared]: exact binomial, 1 at most.
double binomial_p(std::uint64_t seen, std::uint64_t count, double expected, double declared);

/// p-value of a largest distance `distance` between a CDF and the empirical one of `count` samples,
/// of which `declared` is owned: Massart's bound 2 exp(-2 n d^2) (1990), never too small.
double cumulative_p(double distance, double count, double declared);

/// The error in u that `count` samples show with near certainty at significance `p`: the distance
/// at which cumulative_p() is p, and as much again for the sample's own noise.
double visible_u_error(double count, double p);

/// The relative error (root mean square over `bins` bins) that Pearson's statistic shows: it moves
/// the statistic by n e^2, and its standard deviation sqrt(2 bins) is to be exceeded threefold.
double visible_bin_error(double count, std::size_t bins);

}  // namespace vndf::validate
