// From the slopes of a texture to a slope distribution: where its centre lies, how it is stretched,
// and the radial density that is left. The slopes of the map are
//
//   x = mean_x + alpha_x z1,   y = mean_y + alpha_y (c z1 + sqrt(1 - c^2) z2),   c = correlation,
//
// with (z1, z2) radially symmetric and E|z1| = 1.
//
// The centre, stretch and correlation are removed from the map and reported as its surface, on
// which a renderer samples the distribution (on_surface.h). The unit is E|X|, which is finite
// wherever visible normals exist; the standard deviation of GGX is infinite. Centre and stretch are
// the maximum-likelihood estimates for a bivariate Cauchy distribution. They are right for every
// elliptical distribution, and as precise for heavy tails as for light ones, which sample means and
// covariances are not (Kent and Tyler 1991).
#pragma once

#include <memory>
#include <span>
#include <stdexcept>
#include <string>

#include "vndf/distributions/measured_profile.h"
#include "vndf/surface_slopes.h"
#include "vndf/vec.h"

namespace vndf::distributions {

/// Fewest texels of a map.
inline constexpr std::size_t kFewestTexels = 1000;
/// Largest departure from radial symmetry that is accepted unless it is ignored, beyond four
/// standard deviations of its noise: at 0.05 the azimuth CDF within any eighth of the texels is off
/// by less than 0.05 / pi.
inline constexpr double kMaxAsymmetry = 0.05;

/// The slopes of a map are not radially symmetric, whatever the stretch.
class AsymmetricMap : public std::domain_error {
 public:
  using std::domain_error::domain_error;
};

struct SlopeMapOptions {
  /// Name of the distribution.
  std::string name = "slope-map";
  /// Accept a map whose slopes are not radially symmetric; its azimuths are then averaged.
  bool ignore_asymmetry = false;
};

struct SlopeMapStatistics {
  std::size_t texels = 0;
  /// Its mean is the centre of the slopes, its alpha E|x - mean_x| and E|y - mean_y| of the
  /// estimated distribution, and its correlation that of the stretch, which equals the correlation
  /// coefficient where that exists.
  SurfaceSlopes surface{};
  /// With a probability of 95 % no visible CDF of the distribution of the map is farther than this
  /// from that of the estimate: the Dvoretzky-Kiefer-Wolfowitz bound sqrt(log(2 / 0.05) / (2 n)).
  /// At grazing incidence slopes count in proportion to their length r, so n is the number of
  /// texels that weights r leave effective, (sum r)^2 / sum r^2. A lower bound in two cases:
  /// neighbouring texels of a smooth map depend on each other; and where the tail falls slower than
  /// r^-4 the sum of squares has no limit, so the bound itself is uncertain by a factor of two or
  /// so.
  double u_error = 0;
  /// Largest Fourier coefficient |E exp(i k phi)|, k = 1 ... 8, of the azimuth and largest spread
  /// of its CDF (Kuiper), over the eighths of the texels by radius, less their noise: 0 to 1.
  double asymmetry = 0;
  /// The largest asymmetry that is accepted unless it is ignored.
  double asymmetry_bound = 0;
};

struct SlopeMapEstimate {
  /// Mass 1 and E|X| = 1. The kind of its tail is the likeliest for the largest hundredth of the
  /// radii: power (Hill), exponential, or none (uniform up to an edge).
  std::unique_ptr<MeasuredProfile> distribution;
  SlopeMapStatistics statistics;
};

/// Estimates the distribution of `slopes`, one for each texel. Throws std::domain_error for fewer
/// than kFewestTexels, a slope that is not finite, slopes that do not spread in two directions, and
/// a tail too heavy for a finite mean slope; AsymmetricMap for an asymmetry above its bound, unless
/// options.ignore_asymmetry is set.
SlopeMapEstimate estimate_slope_map(std::span<const Vec2<double>> slopes,
                                    const SlopeMapOptions& options = {});

}  // namespace vndf::distributions
