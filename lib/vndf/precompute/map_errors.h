// Errors of a sampler's map u -> x(u), by the exact CDF of the slopes x that it returns, and places
// off the grid of a table at which to measure them.
//
// The u-error |CDF(x(u)) - u| is the Kolmogorov distance between the sampled and the exact
// distribution. It is finite in tails where the difference of slopes has no bound.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "vndf/support/low_discrepancy.h"
#include "vndf/table_coordinates.h"

namespace vndf::precompute {

/// The probability `u`, or that of complement `q`. Each keeps all digits of the smaller of the two.
inline Probability<double> from_tail(double u) {
  return {u, 1 - u};
}
inline Probability<double> from_complement(double q) {
  return {1 - q, q};
}

/// CDF(x(u)) - u without cancellation at either end. `u` is what the sampler was given.
inline double u_error(const Probability<double>& cdf, const Probability<double>& u) {
  return u.u < 0.5 ? cdf.u - u.u : u.complement - cdf.complement;
}

/// Returns `error`, or infinity where it is not a number: a sampler that returns no slope must not
/// pass for a good one.
inline double error_or_largest(double error) {
  return std::isnan(error) ? std::numeric_limits<double>::infinity() : error;
}

/// |d CDF(x(u)) / du - 1|, the relative error of the sampled density, by a central difference at u
/// in (0, 1). `cdf_at(u)` is CDF(x(u)) of the map in double precision.
template <class Cdf>
double density_error(const Cdf& cdf_at, const Probability<double>& u) {
  const double h = 1e-4 * std::min(u.u, u.complement);
  const Probability<double> below{u.u - h, u.complement + h}, above{u.u + h, u.complement - h};
  return std::abs((u_error(cdf_at(above), above) - u_error(cdf_at(below), below)) / (2 * h));
}

/// Returns the sampled over the exact mass of the tail beyond the slope of exact mass `e`. That is
/// e_hat / e with mass(e_hat) = e, where `mass` increases. The ratio is clamped to [1 / farthest,
/// farthest]; the error of its logarithm is 6e-8 times that of `farthest`.
template <class Mass>
double tail_ratio(Mass mass, double e, double farthest) {
  double low = std::log(e / farthest), high = std::log(e * farthest);
  for (int i = 0; i < 24; ++i) {
    const double middle = (low + high) / 2;
    (mass(std::exp(middle)) < e ? low : high) = middle;
  }
  return std::exp((low + high) / 2) / e;
}

/// Replaces `ratio` by `candidate` if that is farther from 1, up or down.
inline void keep_farthest(double& ratio, double candidate) {
  if (std::abs(std::log(candidate)) > std::abs(std::log(ratio))) ratio = candidate;
}

/// Returns row coordinates off the grid of `rows` nodes: `count` ones of the golden sequence and
/// the middles of the outermost cells.
inline std::vector<double> off_grid_rows(std::size_t rows, std::size_t count) {
  constexpr std::size_t kEdgeRows = 12;
  std::vector<double> places;
  for (std::size_t k = 0; k < count; ++k) places.push_back(support::golden(k));
  for (std::size_t k = 0; k < std::min(kEdgeRows, rows - 1); ++k) {
    const double middle = (static_cast<double>(k) + 0.5) / static_cast<double>(rows - 1);
    places.push_back(middle);
    places.push_back(1 - middle);
  }
  return places;
}

/// Adds probabilities from 1e-9 to 1e-2, equidistant in their logarithm, at both ends.
inline void add_tails(std::vector<Probability<double>>& places) {
  constexpr std::size_t kSteps = 24;
  for (std::size_t k = 0; k <= kSteps; ++k) {
    const double e = 1e-9 * std::pow(1e7, static_cast<double>(k) / kSteps);
    places.push_back(from_tail(e));
    places.push_back(from_complement(e));
  }
}

}  // namespace vndf::precompute
