// Whether a normal distribution D(theta, alpha) is shape-invariant: whether alpha only stretches
// its slopes, so that one table serves every roughness (Heitz and d'Eon 2014, section 2). With
// p22(r; alpha) = D cos^4 at r = tan(theta), it is if alpha^2 p22(alpha t; alpha), normalised, is
// the same function of t for all alpha.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>

namespace vndf::distributions {

/// D of an angle from 0 to pi / 2 and a roughness. Any scale.
using Ndf = std::function<double(double theta, double alpha)>;

/// The largest violation found.
struct ShapeInvariance {
  double violation;        ///< relative difference of two densities, 0 (invariant) to 1
  double alpha;            ///< of the smaller density
  double reference_alpha;  ///< of the larger density
  double r;                ///< at slope r times alpha, r times reference_alpha
};

/// Below it the differences are those of arithmetic, as from formulas with rounded constants.
inline constexpr double kShapeInvariant = 1e-6;

/// Compares seven roughnesses from 0.05 to 0.9 at slopes of 1e-3 to 1e3 roughnesses, where a factor
/// e of slope holds at least 1e-6 of the normals. Throws std::domain_error, naming the place, where
/// D is negative, infinite or not a number, or zero at all slopes of a roughness.
ShapeInvariance measure_shape_invariance(const Ndf& ndf);

/// A roughness changes the shape of the distribution.
class NotShapeInvariant : public std::domain_error {
 public:
  using std::domain_error::domain_error;
};

/// Throws NotShapeInvariant, which names the violation and where it is, if
/// measure_shape_invariance() finds more than kShapeInvariant. The surface of one alpha is still a
/// shape: see FormulaDistribution::from_ndf(). `name` is for the message.
void require_shape_invariant(const Ndf& ndf, const std::string& name);

}  // namespace vndf::distributions
