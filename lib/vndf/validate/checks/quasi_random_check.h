// Quasi-random check: the distribution of normals that are sampled at quasi-random points. The
// distance between the exact and the empirical CDF of each uniform number (uniformity.h) falls
// almost like 1 / n for such points, where random ones give 1 / sqrt(n). A million points therefore
// show an error in u of 2e-4 and ten million one of 3e-5, whatever the map.
#pragma once

#include <cstddef>
#include <vector>

#include "vndf/support/parallel.h"
#include "vndf/validate/sampler/sampler_under_test.h"
#include "vndf/validate/statistics/check_result.h"

namespace vndf::validate {

/// The distance that n quasi-random points of an exact sampler leave is below kQuasiRandomError /
/// n^(3/4), the error of counting lattice points in a region with a curved edge. The largest that
/// was measured is 3.1, of spherical caps.
inline constexpr double kQuasiRandomError = 5;

/// The largest distance of each uniform number over check_configurations(), `points` samples at
/// each. The bound is the u-error that is allowed or declared, and what quasi-random points leave.
std::vector<CheckResult> check_quasi_random(const SamplerUnderTest& sampler, std::size_t points,
                                            const support::Workers& workers);

}  // namespace vndf::validate
