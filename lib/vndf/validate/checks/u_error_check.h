// Check: the map from random numbers to normals, without random numbers. |CDF(x(u)) - u| over
// incidence and u with both tails, where x is the slope of the normal that was returned, so that
// its rounding counts: first of the marginal, then of the conditional at the slope x that was
// sampled. Only for samplers that claim to be the monotone inverse of the distribution.
#pragma once

#include <vector>

#include "vndf/support/parallel.h"
#include "vndf/validate/sampler/sampler_under_test.h"
#include "vndf/validate/statistics/check_result.h"

namespace vndf::validate {

struct UErrorOptions {
  /// Golden places of u1 in each row; as many again lie in the tails and the octaves.
  std::size_t places = 500;
  /// Slopes x in each row at which the conditional is checked, some milliseconds each.
  std::size_t slopes = 8;
  /// Check only every n-th incidence.
  std::size_t stride = 1;
  support::Workers workers = {};
};

/// Largest step of the CDF that the map may make back, or at once forward, between neighbouring
/// single-precision random numbers: the rounding of the normal.
inline constexpr double kStep = 4e-6;

/// u-errors of both slopes, with u within [2^-20, 1 - 2^-20] and in the tails beyond; the mass of
/// the tails; order and continuity.
std::vector<CheckResult> check_u_error(const SamplerUnderTest& sampler,
                                       const UErrorOptions& options);

/// Configurations at which maps are checked, azimuths along the axes and roughness 1 unless said:
/// the stretch and the rotation then add no rounding to the slopes.
std::vector<Configuration> inverse_configurations();

}  // namespace vndf::validate
