// Counts of uniform numbers and what they say: whether sampled normals have the distribution that
// they claim. Bins are prime in number, so that none is aligned with the cells of a table; none is
// pooled. Tails are counted by octaves to the last that can be resolved.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "vndf/validate/exact/exact_distribution.h"
#include "vndf/validate/statistics/check_result.h"

namespace vndf::validate {

/// Bins of one variable and of the two sides of the unit square, all prime.
inline constexpr std::size_t kBins = 10007, kSideR = 101, kSidePhi = 103;

/// The errors that a sampler owns to: counts are checked against the nearest distribution within
/// them.
struct DeclaredErrors {
  double u = 0;        ///< of the CDF
  double density = 0;  ///< relative, of the density
  double tail = 0;     ///< relative, of the mass of a tail of 1e-6, either way
};

/// How many bins the numbers of samples can fill with at least 5 each.
struct BinCounts {
  std::size_t line, side_r, side_phi;
};
BinCounts bins_for(std::uint64_t samples);

/// Counts of one uniform variable.
class LineCounts {
 public:
  explicit LineCounts(std::size_t bins);
  void add(double w);
  void add(const LineCounts& other);

  /// Pearson's statistic over all bins, and its p-value.
  double pearson() const;
  double chi_square(const DeclaredErrors& declared) const;
  /// The largest distance between the exact and the empirical CDF, at the ends of bins.
  double distance() const;
  /// Its p-value.
  double cumulative(const DeclaredErrors& declared) const;

  /// Octaves [2^-k-1, 2^-k) from kFirstOctave on in which at least kFewest samples are expected.
  std::size_t octaves() const;
  /// Smallest p-value of the octaves at the lower and the upper end; `ratio` is the seen over the
  /// expected count there.
  double tails(const DeclaredErrors& declared, double& ratio) const;

  std::uint64_t samples() const { return samples_; }

 private:
  static constexpr int kFirstOctave = 6, kOctaves = 36;
  static constexpr double kFewest = 16;

  std::vector<std::uint64_t> bins_;
  std::array<std::uint64_t, kOctaves> lower_{}, upper_{};
  std::uint64_t samples_ = 0;
};

/// Counts of all uniform variables of one configuration.
class UniformCounts {
 public:
  explicit UniformCounts(const BinCounts& bins);
  void add(const Uniforms& w);
  void add(const UniformCounts& other);

  /// One result for each statistic, at `where`.
  std::vector<CheckResult> results(const DeclaredErrors& declared, const std::string& check,
                                   const Place& where) const;

 private:
  double square_p(const DeclaredErrors& declared) const;

  std::size_t side_r_, side_phi_;
  LineCounts r_, phi_, x_;
  std::vector<std::uint64_t> square_;
};

/// Independent tests behind the p-values of `results`.
std::size_t number_of_tests(const std::vector<CheckResult>& results);

/// Gives each p-value its bound: Sidak's correction over `tests`.
void bound_probabilities(std::vector<CheckResult>& results, double significance, std::size_t tests);

/// Keeps of every statistic in both lists the worse result, and adds the numbers of tests.
void merge_results(std::vector<CheckResult>& all, const std::vector<CheckResult>& more);

}  // namespace vndf::validate
