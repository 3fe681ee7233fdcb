// Check: inputs at the edges of their ranges. Roughness 1e-4 to 10 at ratios up to 1:1000,
// incidence from the pole to the horizon at 90 - 1e-7 degrees and 90, and random numbers 0, the
// smallest there is, 1/2, the largest below 1, and 1. Every normal must be a finite unit vector,
// not below the horizon, that faces wi; pdf there finite and not negative.
#pragma once

#include <vector>

#include "vndf/validate/sampler/sampler_under_test.h"
#include "vndf/validate/statistics/check_result.h"

namespace vndf::validate {

/// Largest | |wm| - 1 |: the rounding of single precision.
inline constexpr double kUnitSlack = 1e-6;
/// Largest -dot(wi, wm) over 1 + alpha mu, mu the mean slope: the rounding of a stretched slope at
/// the edge of visibility, some 1e-6 in units of mu, is unstretched by alpha mu.
inline constexpr double kFacingError = 1e-6;

std::vector<CheckResult> check_hard_cases(const SamplerUnderTest& sampler);

}  // namespace vndf::validate
