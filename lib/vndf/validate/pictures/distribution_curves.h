// The functions of a distribution as curves, exact beside the sampler's own: p22, Lambda and D.
#pragma once

#include <vector>

#include "vndf/validate/sampler/sampler_under_test.h"

namespace vndf::validate {

/// One function over an axis, at places that are the same for both values.
struct Curve {
  double alpha;  ///< roughness along x and y
  std::vector<double> at = {}, exact = {}, sampler = {};
};

/// All curves of one sampler.
struct DistributionCurves {
  /// p22 over the slope radius, at roughness 1. The places are equally far apart in log r, from a
  /// hundredth of the mean slope to the largest slope, or to where 1e-6 of the slopes lie beyond.
  Curve p22;
  std::vector<Curve> lambda;  ///< over theta in degrees, 0.5 to 89.5, for each of the roughnesses
  std::vector<Curve> d;       ///< over the angle of wm in degrees, 0 to 89.5, likewise
};

/// The curves of `sampler` at each of `roughnesses` > 0, with `places` >= 2 values each.
DistributionCurves distribution_curves(const SamplerUnderTest& sampler,
                                       const std::vector<double>& roughnesses, std::size_t places);

}  // namespace vndf::validate
