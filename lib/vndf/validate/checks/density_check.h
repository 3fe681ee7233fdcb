// Density check: a renderer divides by pdf(), so it must be the density of the normals that are
// drawn. pdf must integrate to 1 over the normals, be the exact density at sampled normals, and be
// 1 / |Jacobian| of the map where the map is known in double precision. D, Lambda and G1, which pdf
// and the BSDFs are made of, must agree with their definitions.
#pragma once

#include <vector>

#include "vndf/support/parallel.h"
#include "vndf/validate/sampler/sampler_under_test.h"
#include "vndf/validate/statistics/check_result.h"

namespace vndf::validate {

/// Whether the sampler lets the density of its map be found, which the last of the errors needs.
bool tells_density(const SamplerUnderTest& sampler);

/// The errors of all these functions, the largest over check_configurations(), with the bounds
/// Bounds::function_error and density_error.
std::vector<CheckResult> check_density(const SamplerUnderTest& sampler,
                                       const support::Workers& workers);

}  // namespace vndf::validate
