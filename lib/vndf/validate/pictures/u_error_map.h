// The u-error as a picture: |CDF(x(u)) - u| of the slope x over incidence and u1, and of the slope
// y over the slope x and u2. It shows where in the tables an error is, of which the u-error check
// gives the largest. Only for samplers that claim to be the monotone inverse.
#pragma once

#include <vector>

#include "vndf/support/parallel.h"
#include "vndf/validate/pictures/grid.h"
#include "vndf/validate/sampler/sampler_under_test.h"

namespace vndf::validate {

/// The axes of u run from this to its complement. Single-precision numbers above 1/2 are 2^-24 =
/// 6e-8 apart, so that nothing lies beyond.
inline constexpr double kSmallestShownU = 1e-7;

/// u-errors over two axes.
struct UErrorMap {
  std::vector<double> row;  ///< theta in degrees; or u1, at which the slope x is sampled
  std::vector<double> u;    ///< u1; or u2
  /// Not a number where the sampler claims no map, or where the slope cannot be checked.
  Grid error;
};

/// `count` >= 2 single-precision numbers from kSmallestShownU to its complement, equally far apart
/// in log(u / (1 - u)), so that both tails are as wide as the middle.
std::vector<double> logit_places(std::size_t count);

/// The u-error of slope x at roughness 1, for `rows` incidences from 0 to 90 degrees and u2 = 1/2.
UErrorMap marginal_error_map(const SamplerUnderTest& sampler, std::size_t rows, std::size_t columns,
                             const support::Workers& workers);

/// The u-error of slope y at roughness 1 seen from `theta`, given the slope x that is sampled at
/// `rows` places of u1. Its distribution does not depend on theta, which only says which slopes x
/// are in sight.
UErrorMap conditional_error_map(const SamplerUnderTest& sampler, double theta, std::size_t rows,
                                std::size_t columns, const support::Workers& workers);

}  // namespace vndf::validate
