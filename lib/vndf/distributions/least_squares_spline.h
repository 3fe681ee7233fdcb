// The cubic spline that follows weighted samples with the least sum of squares. It has far fewer
// pieces than there are samples, so it averages their noise where an interpolant would follow it.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace vndf::distributions {

/// Samples of a function at increasing places `t`, with their weights > 0. All three are equally
/// long.
struct WeightedSamples {
  std::span<const double> t, value, weight;
};

/// A function with two continuous derivatives that is a cubic between neighbouring knots.
class LeastSquaresSpline {
 public:
  /// `knots` increase from the first to the last place of the samples, with samples in every piece
  /// between them. The sums are of B-splines (de Boor 1978), which keep the equations banded, so
  /// the cost is in proportion to the number of samples and not to that of the knots.
  LeastSquaresSpline(const WeightedSamples& samples, std::span<const double> knots);

  /// The value at `t` between the first and the last knot.
  double at(double t) const;

 private:
  std::size_t piece_of(double t) const;

  std::vector<double> knots_;         // the first and the last are there four times
  std::vector<double> coefficients_;  // of the B-splines
};

}  // namespace vndf::distributions
