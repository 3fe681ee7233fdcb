// The distribution of the radius r of a visible slope, seen from cotangent c, in units of the mean
// slope. In polar slopes (r, phi) the visible density of Heitz and d'Eon 2014, equation 10, is
// p22(r) r (cos t - r sin t cos phi)+ / N; its integral over phi is closed,
//
//   A(r) = 2 [cos t (pi - phi0) + r sin t sin phi0],  phi0 = acos(min(1, c / r))
//
// so that the radius has the density p22(r) r A(r) / N, one integral away from its CDF. The table
// builder works in Cartesian slopes and never forms this integral: it is the validator's own.
#pragma once

#include <vector>

#include "vndf/precompute/unit_slopes.h"
#include "vndf/table_coordinates.h"

namespace vndf::validate {

/// Largest error of RadialDistribution::cdf, and the largest relative one in either tail down to
/// kRadialSmallestTail: both far below what a count of samples can see.
inline constexpr double kRadialError = 1e-8;
inline constexpr double kRadialTailError = 1e-4;
inline constexpr double kRadialSmallestTail = 1e-11;

/// Half the angle in which facets of one radius are visible, and what they are seen of.
struct AngularMass {
  double phi0;  ///< facets with |phi| < phi0 face away
  double half;  ///< A(r) / 2
};

/// A(r) of the facets with slope (height w, horizontal h), r = h / w, times w: finite to the
/// horizon.
AngularMass angular_mass(double cosine, double sine, double h, double w);

class RadialDistribution {
 public:
  /// Seen from cotangent `c` >= 0, infinite and 0 included. Sums p22 over graded panels, some
  /// milliseconds.
  RadialDistribution(const precompute::UnitSlopes& slopes, const BoundedSlope<double>& c);

  /// P(R <= sinh(a)) with its complement, a >= 0, infinite included.
  Probability<double> cdf(double a) const;

  /// Integral of p22 (cos t - x sin t)+ over the slope plane: (cos t)(1 + Lambda), by other means
  /// than the table builder's.
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

/// The same CDF at one place, without tables: some microseconds. `all` is the distribution at
/// normal incidence of the same slopes.
Probability<double> radial_cdf(const precompute::UnitSlopes& slopes, const RadialDistribution& all,
                               const BoundedSlope<double>& c, double a);

}  // namespace vndf::validate
