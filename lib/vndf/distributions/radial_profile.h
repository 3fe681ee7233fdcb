// Samples of a radial density, as they come from a measurement, and what they must be.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace vndf::distributions {

/// Samples of p22 at slope radii r, each in any unit, because the builder normalises both.
struct RadialProfile {
  std::vector<double> r, p22;
};

/// Fewest samples of a profile: a spline needs four.
inline constexpr std::size_t kFewestProfileSamples = 4;
/// Radii other than 0 and the largest density lie within these limits, so that no integral of a
/// profile overflows or loses digits. Other units keep them. diagnose() looks no farther either.
inline constexpr double kSmallestRadius = 1e-30, kLargestRadius = 1e8;
inline constexpr double kSmallestPeak = 1e-30, kLargestPeak = 1e30;
/// Two radii that differ by less than this part count as the same: rounding alone would decide how
/// steep the density is between them.
inline constexpr double kSmallestRadiusStep = 1e-9;

/// Returns the samples without superfluous zeros at both ends, after it has checked them: as many
/// radii as densities, four at least; radii >= 0 that increase by more than kSmallestRadiusStep;
/// densities >= 0, some of them positive, and no zero between positive ones; all within the limits
/// above. Throws std::invalid_argument, which names the sample (from
/// 1), the rule and what to do.
RadialProfile checked_profile(RadialProfile samples);

/// log p22 of a profile is a smooth function of log(1 + r^2 / s^2), because a flat centre and a
/// power tail are both straight lines in it. s is the largest radius with at least half the largest
/// density, or the first radius beyond 0.
class ProfileCoordinate {
 public:
  explicit ProfileCoordinate(const RadialProfile& samples);

  double operator()(double r) const;
  /// The slope in this coordinate of a function with the slope `per_radius` in r, at r > 0.
  double slope(double per_radius, double r) const {
    return per_radius * (1 / inverse_square_scale_ + r * r) / (2 * r);
  }

 private:
  double inverse_square_scale_;
};

}  // namespace vndf::distributions
