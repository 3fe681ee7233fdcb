// The marginal distribution of visible slopes at one incidence (Heitz and d'Eon 2014, equations 10
// and 11), in units of the mean slope, with a = asinh(x) for the slope x and c = cot(theta):
//
//   V(x) = [cos F(x) + sin M(x)] / N  for x <= c,   N = cos F(c) + sin M(c),   F = 1 - Q
//   1 - V(x) = sin int_x^c (c - t) P(t) dt / N
//
// The second form is the one without cancellation near x = c.
#pragma once

#include "vndf/precompute/unit_slopes.h"
#include "vndf/table_coordinates.h"

namespace vndf::precompute {

class MarginalDistribution {
 public:
  /// Takes the cotangent `c` >= 0 of the incident direction, infinite (normal incidence) and 0
  /// (grazing) included. `slopes` must outlive this object.
  MarginalDistribution(const UnitSlopes& slopes, const BoundedSlope<double>& c);

  /// asinh of the largest visible slope: that of c, infinite at normal incidence, or the largest
  /// slope of the distribution if that is smaller.
  double farthest() const { return farthest_; }

  /// V and 1 - V at sinh(a), a <= farthest(). Maximum error: 1e-12, relative to the smaller of the
  /// two.
  Probability<double> cdf(double a) const;

  /// a with V(sinh(a)) = u, to 1e-12 in u: -infinity at u = 0 and farthest() at u = 1. `guess` is
  /// any number; a near one saves time.
  double quantile(const Probability<double>& u, double guess) const;

 private:
  double lower_mass(double b) const;            // N V(-sinh(b)), b >= 0
  double upper_mass(double a) const;            // N (1 - V(sinh(a))), a >= 0
  double weighted_density(double a) const;      // -d upper_mass / da
  double gauss(double low, double high) const;  // its integral, where it is smooth

  const UnitSlopes& slopes_;
  double farthest_, cotangent_, cosine_, sine_, smooth_from_, norm_ = 0, turn_ = 0;
};

}  // namespace vndf::precompute
