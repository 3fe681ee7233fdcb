// Check: the distribution of normals sampled at quasi-random points, without random numbers. The
// distance between the exact and the empirical CDF of each uniform variable (uniformity.h) falls
// almost like 1 / n for quasi-random points, where random ones give 1 / sqrt(n): a million show an
// error in u of 2e-4, ten million one of 3e-5, whatever the map.
#pragma once

#include <cstddef>
#include <vector>

#include "vndf/support/parallel.h"
#include "vndf/validate/sampler/sampler_under_test.h"
#include "vndf/validate/statistics/check_result.h"

namespace vndf::validate {

/// Distance that n quasi-random points of an exact sampler leave is below kQuasiRandomError /
/// n^(3/4), the error of counting lattice points in a region with a curved edge. Measured up
/// to 3.1, of spherical caps.
inline constexpr double kQuasiRandomError = 5;

std::vector<CheckResult> check_quasi_random(const SamplerUnderTest& sampler, std::size_t points,
                                            const support::Workers& workers);

}  // namespace vndf::validate
