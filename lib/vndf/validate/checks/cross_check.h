// Cross-check: the sampler beside the exact monotone map, on the same random numbers, so that an
// error is found whichever of the two slopes it is in.
//
// The difference of two normals is told in u, which has a bound, and as the angle between them,
// which has none: where the density is small a large angle is no error. The u of the difference are
// the uniform numbers of the normals (exact_distribution.h). Radius and azimuth move by more than
// the error of the map where its slopes are in a tail, so a difference counts as the error in
// (u1, u2) that would make it.
#pragma once

#include <vector>

#include "vndf/support/parallel.h"
#include "vndf/validate/sampler/sampler_under_test.h"
#include "vndf/validate/statistics/check_result.h"

namespace vndf::validate {

/// The normal of the exact monotone map at (u1, u2) in [0, 1]: root finding on the exact CDFs in
/// double precision, which takes some 0.1 ms. Slope y is 0 at a slope x that ExactConditional
/// leaves out.
Vec3<double> exact_normal(const ExactSlopes& exact, const Configuration& configuration, double u1,
                          double u2);

/// The largest difference in u over `points` quasi-random pairs at each of check_configurations(),
/// for samplers that claim to be the monotone inverse. Its bound is Bounds::u_error.
std::vector<CheckResult> cross_check(const SamplerUnderTest& sampler, std::size_t points,
                                     const support::Workers& workers);

}  // namespace vndf::validate
