// Hard cases: inputs at the edges of their ranges, where samplers divide by 0 or lose all digits.
// Roughness is from 1e-4 to 10 at ratios up to 1:1000, incidence from the pole, and so close to it
// that the horizontal part of wi cannot be squared in single precision, to the horizon at
// 90 - 1e-7 degrees and 90, and to straight below where that is claimed; random numbers are 0, the
// smallest there is, 1/2, the largest below 1, and 1. Every normal must be a finite unit vector
// that is not below the horizon and faces wi where enough is visible, and pdf there must be finite
// and not negative.
#pragma once

#include <vector>

#include "vndf/validate/sampler/sampler_under_test.h"
#include "vndf/validate/statistics/check_result.h"

namespace vndf::validate {

/// The largest error of the length of a normal: the rounding of single precision.
inline constexpr double kUnitSlack = 1e-6;
/// The largest -dot(wi, wm) over facing_stretch(), which is 1 + alpha mu on a flat surface. At the
/// edge of visibility a stretched slope is rounded by some 1e-6 in units of mu.
inline constexpr double kFacingError = 1e-6;

/// The worst of each over all these inputs.
std::vector<CheckResult> check_hard_cases(const SamplerUnderTest& sampler);

}  // namespace vndf::validate
