// The distribution of sampled slopes as a picture: a histogram of the slopes of sampled normals
// beside the exact distribution, the density of visible slopes P22_wi (Heitz and d'Eon 2014,
// equation 10), and the difference in standard errors, which shows what the eye cannot see in the
// two.
#pragma once

#include <cstdint>

#include "vndf/support/parallel.h"
#include "vndf/validate/pictures/grid.h"
#include "vndf/validate/sampler/sampler_under_test.h"

namespace vndf::validate {

/// Largest error of a cell of the exact distribution, relative to the largest cell, for the
/// distributions shipped: that of a cell through which the density jumps.
inline constexpr double kCellError = 1e-3;

/// Cells in which fewer samples are expected are left out of the mean square deviation.
inline constexpr double kFewestInCell = 5;

/// The largest deviation that is told apart, that of a normal where there is none to be seen.
inline constexpr double kLargestDeviation = 30;

struct HistogramOptions {
  /// On a side. An odd number has slope 0 in the middle of a cell.
  std::size_t cells = 81;
  std::uint64_t samples = 1000000;
  /// Every random number follows from it, whatever the number of threads.
  std::uint64_t seed = 1;
  /// Tells the samples of several histograms of one seed apart.
  std::uint64_t stream = 0;
  support::Workers workers = {};
};

/// Over the square of slopes -half_width to half_width, x to the right and y up, in the units of
/// the distribution's own definition.
struct SlopeHistogram {
  Configuration configuration = {};
  double half_width = 0;
  std::uint64_t samples = 0;
  Grid sampled = {}, exact = {};  ///< mean density per unit of slope plane in each cell
  /// Samples counted less expected, as the normal deviate of the same probability: exact for few
  /// expected samples too (Poisson's distribution, half of what is equal counted as less).
  Grid deviation = {};
  double inside = 0;  ///< exact mass of the square
  /// Mean square of the deviations where at least kFewestInCell samples are expected, and how many
  /// cells that are: for an exact sampler 1 with a standard error of sqrt(2 / checked).
  double mean_square = 0;
  std::size_t compared = 0;
};

/// Half the side of a square that shows the slopes of `distribution` at `alpha`: of the smallest 85
/// of 100, or of all where the largest slope is finite.
double shown_slopes(const ExactSlopes& exact, const Alpha<double>& alpha);

/// The exact distribution alone: mean density in each of `cells` x `cells`.
Grid exact_slope_density(const SamplerUnderTest& sampler, const Configuration& configuration,
                         double half_width, std::size_t cells);

/// The deviate of `count` where `expected` are expected, within -+kLargestDeviation.
double poisson_deviate(std::uint64_t count, double expected);

SlopeHistogram slope_histogram(const SamplerUnderTest& sampler, const Configuration& configuration,
                               double half_width, const HistogramOptions& options);

}  // namespace vndf::validate
