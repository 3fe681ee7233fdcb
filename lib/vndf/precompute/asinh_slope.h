// Slopes x as a = asinh(x). The builder works in this coordinate because densities of slopes are
// smooth in it from the smallest slopes to power tails, which are straight lines in log Q over a.
// It is the logit of the bounded form of table_coordinates.h:
//
//   sigma(x) = 1 / (1 + exp(-asinh(x)))
#pragma once

#include <cmath>

#include "vndf/table_coordinates.h"

namespace vndf::precompute {

/// asinh of a slope, from -infinity at sigma = 0 to infinity at sigma = 1.
inline double asinh_of(const BoundedSlope<double>& slope) {
  return std::log(slope.sigma / slope.complement);
}

/// Inverse of asinh_of().
inline BoundedSlope<double> bounded_from_asinh(double a) {
  return {1 / (1 + std::exp(-a)), 1 / (1 + std::exp(a))};
}

}  // namespace vndf::precompute
