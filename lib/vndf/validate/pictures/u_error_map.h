// The u-error of a map as a picture: |CDF(x(u)) - u| of the slope x over incidence and u1, and of
// the slope y over the slope x and u2. Only for samplers that claim to be the monotone inverse.
#pragma once

#include <vector>

#include "vndf/support/parallel.h"
#include "vndf/validate/pictures/grid.h"
#include "vndf/validate/sampler/sampler_under_test.h"

namespace vndf::validate {

/// Both ends of the u axes: single-precision numbers above 1/2 are 2^-24 = 6e-8 apart.
inline constexpr double kSmallestShownU = 1e-7;

struct UErrorMap {
  std::vector<double> row;  ///< theta in degrees; or u1, at which the slope x is sampled
  std::vector<double> u;    ///< u1; or u2
  /// Not a number where the sampler claims no map or the slope cannot be checked.
  Grid error;
};

/// `count` single-precision numbers from kSmallestShownU to its complement, equidistant in
/// log(u / (1 - u)), so that both tails are as wide as the middle.
std::vector<double> logit_places(std::size_t count);

/// Slope x at roughness 1, `rows` incidences from 0 to 90 degrees, u2 = 1/2.
UErrorMap marginal_error_map(const SamplerUnderTest& sampler, std::size_t rows, std::size_t columns,
                             const support::Workers& workers);

/// Slope y at roughness 1 seen from `theta`, given the slope x that is sampled at `rows` places of
/// u1. Its distribution does not depend on theta, which only says which slopes x are in sight.
UErrorMap conditional_error_map(const SamplerUnderTest& sampler, double theta, std::size_t rows,
                                std::size_t columns, const support::Workers& workers);

}  // namespace vndf::validate
