// The distribution of sampled slopes as a picture: a histogram of the slopes of sampled normals
// beside the exact density of visible slopes P22_wi (Heitz and d'Eon 2014, equation 10), and the
// difference in standard errors, which shows what the eye cannot see in the two.
#pragma once

#include <cstdint>

#include "vndf/support/parallel.h"
#include "vndf/validate/pictures/grid.h"
#include "vndf/validate/sampler/sampler_under_test.h"

namespace vndf::validate {

/// The largest error of a cell of the exact density, relative to the largest cell, for the
/// distributions that are shipped: that of a cell through which the density jumps.
inline constexpr double kCellError = 1e-3;

/// Cells in which fewer samples are expected are left out of the mean square deviation.
inline constexpr double kFewestInCell = 5;

/// The largest deviation that is told apart: a sample where none may be deviates by this.
inline constexpr double kLargestDeviation = 30;

/// What is drawn.
struct HistogramOptions {
  /// Cells on a side. With an odd number slope 0 is in the middle of a cell.
  std::size_t cells = 81;
  std::uint64_t samples = 1000000;
  /// Every random number follows from it, whatever the number of threads.
  std::uint64_t seed = 1;
  /// Tells the samples of several histograms with one seed apart.
  std::uint64_t stream = 0;
  support::Workers workers = {};
};

/// A histogram over the square of slopes from -half_width to half_width, x to the right and y up,
/// in the units of the distribution's own definition.
struct SlopeHistogram {
  Configuration configuration = {};
  double half_width = 0;
  std::uint64_t samples = 0;
  Grid sampled = {}, exact = {};  ///< mean density per unit of slope plane in each cell
  /// Samples that were counted less those that are expected, as the normal deviate of the same
  /// probability. It holds for few expected samples too: in Poisson's distribution, half of what is
  /// equal counts as less.
  Grid deviation = {};
  double inside = 0;  ///< exact probability of the square
  /// The mean square of the deviations in cells where at least kFewestInCell samples are expected,
  /// and the number of these cells. For an exact sampler it is 1 with a standard error of sqrt(2 /
  /// compared).
  double mean_square = 0;
  std::size_t compared = 0;
};

/// Half the side of a square that shows the slopes at `alpha`: all where the largest slope is
/// finite, else the smallest 85 of 100.
double shown_slopes(const ExactSlopes& exact, const Alpha<double>& alpha);

/// The mean exact density in each of `cells` x `cells`. Maximum error kCellError.
Grid exact_slope_density(const SamplerUnderTest& sampler, const Configuration& configuration,
                         double half_width, std::size_t cells);

/// The normal deviate of `count` where `expected` are expected, within -+kLargestDeviation.
double poisson_deviate(std::uint64_t count, double expected);

/// Draws and counts samples of `sampler` at `configuration`.
SlopeHistogram slope_histogram(const SamplerUnderTest& sampler, const Configuration& configuration,
                               double half_width, const HistogramOptions& options);

}  // namespace vndf::validate
