// The distribution of the radius r of a visible slope, seen from cotangent c, in units of the mean
// slope. In polar slopes (r, phi) the visible density of Heitz and d'Eon 2014, equation 10, is
// p22(r) r (cos t - r sin t cos phi)+ / N. Its integral over phi is closed,
//
//   A(r) = 2 [cos t (pi - phi0) + r sin t sin phi0],  phi0 = acos(clamp(c / r, -1, 1))
//
// from above the horizon (c >= 0) and from below it, where slopes of radius |c| or less are not
// seen. so that the radius has the density p22(r) r A(r) / N, one integral away from its CDF.
//
// The table builder works in Cartesian slopes and never forms this integral. The panels, the
// interpolation and the normalisation here are the validator's own, so that it does not repeat a
// mistake of the builder. It takes p22 and the mean slope from UnitSlopes, and the functions
// graded() and bounded_cotangent() of the runtime, which only place nodes and carry the cotangent.
// UnitSlopes::m and q enter radial_cdf(), and in the table they only decide how far it reaches. A
// test compares both ways with each other and with closed forms.
#pragma once

#include <vector>

#include "vndf/precompute/unit_slopes.h"
#include "vndf/table_coordinates.h"

namespace vndf::validate {

/// The largest error of RadialDistribution::cdf(), and its largest relative error in either tail
/// down to a mass of kRadialSmallestTail. Both are far below what a count of samples can see.
inline constexpr double kRadialError = 1e-8;
inline constexpr double kRadialTailError = 1e-4;
inline constexpr double kRadialSmallestTail = 1e-11;

/// The facets of one radius that are visible, and how much of them is seen.
struct AngularMass {
  double phi0;  ///< facets with |phi| < phi0 face away
  double half;  ///< A(r) / 2
};

/// A(r) times w of the facets with slope radius r = h / w. It is given for a fraction because A(r)
/// grows without bound towards the horizon, where w is 0.
AngularMass angular_mass(double cosine, double sine, double h, double w);

/// The CDF of the radius at one incidence, tabulated.
class RadialDistribution {
 public:
  /// Sums p22 over graded panels, seen from cotangent `c` of either sign, at which something is
  /// visible. This takes some milliseconds. `slopes` must outlive this object.
  RadialDistribution(const precompute::UnitSlopes& slopes, const BoundedSlope<double>& c);

  /// P(R <= sinh(a)) and its complement at a >= 0, infinite included. Maximum errors: kRadialError
  /// and kRadialTailError.
  Probability<double> cdf(double a) const;

  /// The integral of p22 (cos t - x sin t)+ over the slope plane, which is (cos t)(1 + Lambda) from
  /// above. It is summed over radii, where the table builder sums over Cartesian slopes.
  double visible_area() const { return visible_area_; }

 private:
  struct Node {
    double head, tail;  // mass below and above
    double slope;       // d head per node
  };
  struct Segment {
    double begin, end;  // asinh(r)
    std::vector<Node> nodes;
  };

  double density(double a) const;  // d mass / d a, not normalised
  void fill(Segment& segment) const;
  void sum_up();
  double mass_beyond(double a) const;

  const precompute::UnitSlopes* slopes_;
  double cosine_, sine_;
  double visible_area_ = 0, beyond_ = 0;
  std::vector<Segment> segments_;
};

/// The same CDF at one place, for a few normals that a table would not pay for: some 10
/// microseconds. `all` is the distribution of the same slopes at normal incidence.
Probability<double> radial_cdf(const precompute::UnitSlopes& slopes, const RadialDistribution& all,
                               const BoundedSlope<double>& c, double a);

}  // namespace vndf::validate
