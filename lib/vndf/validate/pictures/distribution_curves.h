// The functions of a distribution as curves, exact beside the sampler's own: p22, Lambda and D.
#pragma once

#include <vector>

#include "vndf/validate/sampler/sampler_under_test.h"

namespace vndf::validate {

struct Curve {
  double alpha;  ///< along x and y
  std::vector<double> at = {}, exact = {}, sampler = {};
};

struct DistributionCurves {
  /// Over the slope radius, at roughness 1, logarithmic: from a hundredth of the mean slope to
  /// where 1e-6 of the slopes lie beyond, or to the largest.
  Curve p22;
  std::vector<Curve> lambda;  ///< over theta in degrees, 0.5 to 89.5, for each of the roughnesses
  std::vector<Curve> d;       ///< over the angle of wm in degrees, 0 to 89.5, likewise
};

DistributionCurves distribution_curves(const SamplerUnderTest& sampler,
                                       const std::vector<double>& roughnesses, std::size_t places);

}  // namespace vndf::validate
