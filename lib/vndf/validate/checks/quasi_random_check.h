// Stage: the law of normals sampled at even points, without random numbers. The distance between
// the exact and the empirical CDF of each uniform variable (uniformity.h) falls almost like 1 / n
// for even points, where random ones give 1 / sqrt(n): a million show an error in u of 2e-4, ten
// million one of 3e-5, whatever the map.
#pragma once

#include <cstddef>
#include <vector>

#include "vndf/support/parallel.h"
#include "vndf/validate/sampler/sampler_under_test.h"
#include "vndf/validate/statistics/check_result.h"

namespace vndf::validate {

/// Distance that n even points of an exact sampler leave is below kEvenError / n^(3/4), the error
/// of counting lattice points in a region with a curved edge. Measured up to 3.1, of spherical
/// caps.
inline constexpr double kEvenError = 5;

std::vector<Finding> measure_even_law(const Subject& subject, std::size_t points,
                                      const support::Workers& workers);

}  // namespace vndf::validate
