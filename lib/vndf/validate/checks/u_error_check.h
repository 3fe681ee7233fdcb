// U-error check: whether the map from random numbers to normals is the monotone inverse of the
// distribution, which stratified and quasi-random numbers rely on. It measures |CDF(x(u)) - u| over
// incidence and u with both tails, where x is the slope of the normal that was returned, so that
// its rounding counts: first for the marginal, then for the conditional at the slope x that was
// sampled. No random numbers are needed, so errors of 1e-5 are seen. Only for samplers that claim
// the map.
#pragma once

#include <vector>

#include "vndf/support/parallel.h"
#include "vndf/validate/sampler/sampler_under_test.h"
#include "vndf/validate/statistics/check_result.h"

namespace vndf::validate {

/// How many places are checked.
struct UErrorOptions {
  /// Places of u1 in each row by the golden sequence; as many again are in the tails.
  std::size_t places = 500;
  /// Slopes x in each row at which the conditional is checked, some milliseconds each.
  std::size_t slopes = 8;
  /// Only every n-th incidence is checked.
  std::size_t stride = 1;
  support::Workers workers = {};
};

/// The largest step of the CDF that the map may make back, or forward at once, between neighbouring
/// random numbers of single precision: the rounding of the normal.
inline constexpr double kStep = 4e-6;

/// The u-errors of both slopes, apart for u within [2^-20, 1 - 2^-20] and for the tails beyond,
/// where published samplers end; the mass of the tails beyond u = 2^-20; and whether the map is
/// monotone and continuous, over inverse_configurations(). Bounds: Bounds::u_error,
/// Bounds::tail_error and kStep.
std::vector<CheckResult> check_u_error(const SamplerUnderTest& sampler,
                                       const UErrorOptions& options);

}  // namespace vndf::validate
