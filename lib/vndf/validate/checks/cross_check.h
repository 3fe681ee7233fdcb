// Check: the sampler beside an exact sampler, on the same random numbers. The difference is told in
// u, which has a bound, and as the angle between the normals, which has none: where the density is
// small an angle is large and no error. The u of the difference are the uniforms of the normal
// (exact_distribution.h), of the radius and the azimuth too, which move by more than the u of the
// map where its slopes are of a tail: a difference counts as the error in (u1, u2) that would make
// it.
#pragma once

#include <vector>

#include "vndf/support/parallel.h"
#include "vndf/validate/sampler/sampler_under_test.h"
#include "vndf/validate/statistics/check_result.h"

namespace vndf::validate {

/// The normal of the exact monotone map at (u1, u2): root result on the exact CDFs in double
/// precision, some 0.1 ms. Beyond kSmallestMass slope y is taken as 0.
Vec3<double> exact_normal(const ExactSlopes& exact, const Configuration& configuration, double u1,
                          double u2);

/// For samplers that claim the map; `points` random pairs of each configuration.
std::vector<CheckResult> cross_check(const SamplerUnderTest& sampler, std::size_t points,
                                     const support::Workers& workers);

}  // namespace vndf::validate
