// Check: the density and what it is made of. pdf integrates to 1 over the normals, is the exact
// density of the normals that are sampled, and is 1 / |Jacobian| of the map where that is known in
// double precision; D, Lambda and G1 agree with their definitions.
#pragma once

#include <vector>

#include "vndf/support/parallel.h"
#include "vndf/validate/sampler/sampler_under_test.h"
#include "vndf/validate/statistics/check_result.h"

namespace vndf::validate {

std::vector<CheckResult> check_density(const SamplerUnderTest& sampler,
                                       const support::Workers& workers);

}  // namespace vndf::validate
