// Counts of uniform numbers, and what they say: whether sampled normals have the distribution that
// is claimed. The bins are prime in number, so that none is aligned with the cells of a table, and
// none is pooled with others. Tails are counted by octaves to the last that the samples can
// resolve, because a tail that is cut is lost in a bin.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "vndf/validate/exact/exact_distribution.h"
#include "vndf/validate/statistics/check_result.h"

namespace vndf::validate {

/// Bins of one variable, and of the two sides of the unit square. All are prime.
inline constexpr std::size_t kBins = 10007, kSideR = 101, kSidePhi = 103;

/// The errors that a sampler declares. Counts are compared with the nearest distribution within
/// them.
struct DeclaredErrors {
  double u = 0;        ///< of the CDF
  double density = 0;  ///< relative, of the density
  double tail = 0;     ///< relative, of the mass of a tail of 1e-6, either way
};

/// Numbers of bins that a number of samples fills with at least 5 each.
struct BinCounts {
  std::size_t line, side_r, side_phi;
};
BinCounts bins_for(std::uint64_t samples);

/// Counts of one uniform variable.
class LineCounts {
 public:
  explicit LineCounts(std::size_t bins);
  /// Counts one number in [0, 1].
  void add(double w);
  void add(const LineCounts& other);

  /// Pearson's statistic over all bins.
  double pearson() const;
  /// Its p-value.
  double chi_square(const DeclaredErrors& declared) const;
  /// The largest distance between the exact and the empirical CDF, at the ends of bins.
  double distance() const;
  /// Its p-value.
  double cumulative(const DeclaredErrors& declared) const;

  /// Number of octaves [2^-k-1, 2^-k) from kFirstOctave on in which at least kFewest samples are
  /// expected.
  std::size_t octaves() const;
  /// The smallest p-value of the octaves at the lower and the upper end. `ratio` becomes the seen
  /// over the expected count there.
  double tails(const DeclaredErrors& declared, double& ratio) const;

  std::uint64_t samples() const { return samples_; }

 private:
  static constexpr int kFirstOctave = 6, kOctaves = 36;
  static constexpr std::uint64_t kFewest = 16;

 public:
  /// The fewest samples that have an octave.
  static constexpr std::uint64_t kFewestForTails = kFewest << (kFirstOctave + 1);

 private:
  std::vector<std::uint64_t> bins_;
  std::array<std::uint64_t, kOctaves> lower_{}, upper_{};
  std::uint64_t samples_ = 0;
};

/// Counts of all uniform numbers of one configuration.
class UniformCounts {
 public:
  explicit UniformCounts(const BinCounts& bins);
  void add(const Uniforms& w);
  void add(const UniformCounts& other);

  /// One result for each statistic, as one of the check called `check`, at `where`. Its bound is
  /// set by bound_probabilities().
  std::vector<CheckResult> results(const DeclaredErrors& declared, const std::string& check,
                                   const Place& where) const;

 private:
  double square_p(const DeclaredErrors& declared) const;

  std::size_t side_r_, side_phi_;
  LineCounts r_, phi_, x_;
  std::vector<std::uint64_t> square_;
};

/// Number of independent tests behind the p-values of `results`.
std::size_t number_of_tests(const std::vector<CheckResult>& results);

/// Gives each p-value its bound: Sidak's correction of `significance` for `tests`.
void bound_probabilities(std::vector<CheckResult>& results, double significance, std::size_t tests);

/// Keeps the worse result of every statistic that is in both lists, adds those that are only in
/// `more`, and adds up the numbers of tests.
void merge_results(std::vector<CheckResult>& all, const std::vector<CheckResult>& more);

}  // namespace vndf::validate
