// The configurations at which checks are made, on the surface that a sampler is checked on, and the
// bounds on either side of it.
#pragma once

#include <algorithm>
#include <vector>

#include "vndf/validate/sampler/sampler_under_test.h"
#include "vndf/validate/statistics/check_result.h"

namespace vndf::validate {

/// A surface is left out where its ExactSurface::rounding() is larger. The slopes of a smooth
/// surface with a large mean slope differ by little more than a single-precision normal is rounded.
inline constexpr double kMostRounding = 32;

/// Of the configurations that `sampler` claims, those at which density, furnace, quasi-random,
/// cross- and distribution checks are made: from the pole to the horizon and below it, smooth to
/// rough, with anisotropy up to 1:500.
std::vector<Configuration> check_configurations(const SamplerUnderTest& sampler);

/// Of the configurations at which `sampler` claims to be the monotone inverse, those at which maps
/// are checked. Most have roughness 1 and an azimuth along an axis, so that on a flat surface
/// stretch and rotation add no rounding to the slopes.
std::vector<Configuration> inverse_configurations(const SamplerUnderTest& sampler);

/// The configuration of a flat surface on that of `sampler`, seen from a direction that is as high
/// over the mean facet. One that is not below is above by more than single precision rounds.
Configuration on_surface(const SamplerUnderTest& sampler, const Configuration& flat);

/// Where the surface of `sampler` is one of those that kMostRounding leaves out.
std::vector<Place> left_out(const SamplerUnderTest& sampler);

/// `error` less what the rounding of height() to single precision makes of it, which is nothing
/// where there is no mean slope: Lambda and G1 are in proportion to the height where it is small.
/// Not a number where `error` is none.
double without_height_rounding(double error, const Configuration& c);

/// Configurations on one side of the surface, and the bounds there.
struct Side {
  std::vector<Configuration> list;
  /// Those of the sampler. The u-error may be larger by what single precision rounds where there is
  /// a mean slope.
  Bounds bounds;
  /// What more the CDF may move by between neighbouring random numbers, likewise, and below the
  /// surface for the rounding that the bound of the u-error allows there.
  double rounding;
};
Side side_above(const SamplerUnderTest& sampler, const std::vector<Configuration>& list);
Side side_below(const SamplerUnderTest& sampler, const std::vector<Configuration>& list);

/// The results of check(side) on both sides. A statistic that has one bound on both is one result,
/// the worse; of others the one from below has its own name.
template <class Check>
std::vector<CheckResult> on_both_sides(const SamplerUnderTest& sampler,
                                       const std::vector<Configuration>& list, Check check) {
  std::vector<CheckResult> results = check(side_above(sampler, list));
  const Side below = side_below(sampler, list);
  if (below.list.empty()) return results;
  const std::size_t above = results.size();
  for (CheckResult& f : check(below)) {
    const auto same = std::find_if(
        results.begin(), results.begin() + static_cast<std::ptrdiff_t>(above),
        [&](const CheckResult& a) { return a.statistic == f.statistic && a.bound == f.bound; });
    if (same == results.begin() + static_cast<std::ptrdiff_t>(above)) {
      f.statistic += ", below";
      results.push_back(f);
    } else if (!(f.measured <= same->measured)) {
      *same = f;
    }
  }
  return results;
}

}  // namespace vndf::validate
