// The one-dimensional functions of a radial slope density, each a single integral straight from p22
// over s in [0, infinity) at r = sqrt(x^2 + s^2), by double-exponential quadrature:
//
//   P(x) = 2 int p22 ds                 density of the slope component X
//   Q(x) = 2 int s atan(s / x) p22 ds   upper tail P(X > x)
//   M(x) = 2 int s^2 p22 ds             partial first moment int_x^inf t P(t) dt, M(0) = E|X| / 2
//   B(c) = M(c) - c Q(c) = E[(X - c)+]  = c Lambda(c), by its own integral with a positive
//   integrand
//
// (swap the order of integration in the definitions over the half plane beyond x and use polar
// coordinates there). None is truncated: the tail to infinity is part of the quadrature.
#pragma once

#include <stdexcept>

#include "vndf/distributions/slope_distribution.h"

namespace vndf::distributions {

/// An approximation with the quadrature's own estimate of its absolute error.
struct Estimate {
  double value, error;
};

/// A quadrature does not converge: the integral is infinite, or p22 has a jump that is not among
/// its breaks.
class DivergentIntegral : public std::domain_error {
 public:
  using std::domain_error::domain_error;
};

/// 2 pi int r p22 dr, 1 for a normalised density. Throws std::domain_error, naming the
/// distribution, if p22 is negative or not a number somewhere or the integral is zero, and
/// DivergentIntegral if it does not converge.
Estimate slope_mass(const SlopeDistribution& d);

/// 2 M(0) = E|X| of a density normalised by `mass`. Throws DivergentIntegral if it is infinite:
/// there is then no masking function, hence no distribution of visible normals.
Estimate mean_slope(const SlopeDistribution& d, double mass);

/// P, Q, M and B at a slope >= 0, of the density as it is (not normalised). Maximum relative error
/// 1e-12 for smooth densities.
Estimate marginal_density(const SlopeDistribution& d, double x);
Estimate upper_tail(const SlopeDistribution& d, double x);
Estimate partial_moment(const SlopeDistribution& d, double x);
Estimate backfacing(const SlopeDistribution& d, double c);

struct MarginalEstimates {
  Estimate p, q, m;
};

/// P, Q and M at a slope >= 0, as the distribution knows them or else by quadrature.
MarginalEstimates marginals(const SlopeDistribution& d, double x);

}  // namespace vndf::distributions
