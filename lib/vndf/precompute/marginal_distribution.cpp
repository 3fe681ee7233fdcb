// Evaluates the two forms of the visible CDF, each where it keeps its digits, and inverts them.
#include "vndf/precompute/marginal_distribution.h"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <limits>

#include "vndf/precompute/asinh_slope.h"
#include "vndf/precompute/tabulated_cdf.h"

namespace vndf::precompute {
namespace {

// Within this distance in asinh from the edge at cot(theta), the closed form of 1 - V loses more
// than two digits. There Gauss's rule integrates the positive form instead.
constexpr double kNear = 0.25;
// The rule is exact to rounding where P is smooth, that is where it changes by no more than this
// factor. Next to a narrow part of a mixture the distance is halved until it is, down to kNearest:
// the closed form then loses more digits of a smaller mass. Without this the CDF of a mixture at
// 1:100 was off by 1e-4.
constexpr double kSmoothRatio = 4;
constexpr double kNearest = 1e-6;
// P may have a cusp or a pole at x = 0. Where the rule over the whole way to x = 0 differs by more
// than this from the rule over its halves, it is used over the half next to the edge only. Without
// this the CDF of K slopes of nu = 0.5 was off by 1.1e-4. P itself has an error of this size.
constexpr double kHalvesDiffer = 1e-8;
// exp(-740) is the smallest normal number: no slope that a table holds lies beyond.
constexpr double kFarthestLow = 740;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Whether P changes slowly from `low` to `high`, both asinh of slopes.
bool smooth_over(const UnitSlopes& slopes, double low, double high) {
  constexpr int kPlaces = 8;
  double least = kInfinity, most = 0;
  for (int k = 0; k <= kPlaces; ++k) {
    const double p = slopes.p_da(low + (high - low) * k / kPlaces);
    least = std::min(least, p);
    most = std::max(most, p);
  }
  return most <= kSmoothRatio * least;
}

/// Returns the asinh from which on Gauss's rule serves: near cot(theta), above the last break of P.
/// It is infinite, for never, where the edge is that of the distribution.
double smooth_edge(const UnitSlopes& slopes, double farthest, double cotangent) {
  if (farthest < cotangent) return kInfinity;
  double near = kNear;
  while (near > kNearest && !smooth_over(slopes, farthest - near, farthest)) near /= 2;
  double from = farthest - near;
  for (const double r : slopes.distribution().breaks()) {
    const double place = std::asinh(r / slopes.mean_slope());
    for (const double a : {-place, place})
      if (a < farthest) from = std::max(from, a);
  }
  return from;
}

}  // namespace

MarginalDistribution::MarginalDistribution(const UnitSlopes& slopes, const BoundedSlope<double>& c)
    : slopes_(slopes),
      farthest_(std::min(asinh_of(c), std::asinh(slopes.support()))),
      cotangent_(asinh_of(c)),
      cosine_(c.numerator() / c.hypotenuse()),
      sine_(c.denominator() / c.hypotenuse()),
      smooth_from_(smooth_edge(slopes, farthest_, cotangent_)) {
  if (farthest_ < 0) {
    norm_ = lower_mass(-farthest_);
    turn_ = smooth_from_;
    return;
  }
  norm_ = cosine_ * (1 - slopes.q(cotangent_)) + sine_ * slopes.m(cotangent_);
  const double middle = farthest_ / 2;
  if (smooth_from_ >= middle || !(farthest_ > 0)) return;
  const double whole = gauss(0, farthest_), halves = gauss(0, middle) + gauss(middle, farthest_);
  if (std::abs(whole - halves) > kHalvesDiffer * halves) smooth_from_ = middle;
}

double MarginalDistribution::lower_mass(double b) const {
  return cosine_ * slopes_.q(b) + sine_ * slopes_.m(b);
}

double MarginalDistribution::upper_mass(double a) const {
  if (a >= farthest_) return 0;
  if (a > smooth_from_) return gauss(a, farthest_);
  return cosine_ * (slopes_.q(a) - slopes_.q(farthest_)) -
         sine_ * (slopes_.m(a) - slopes_.m(farthest_));
}

double MarginalDistribution::gauss(double low, double high) const {
  return boost::math::quadrature::gauss<double, 10>::integrate(
      [this](double t) { return weighted_density(t); }, low, high);
}

double MarginalDistribution::weighted_density(double a) const {
  // cos - sin x = sin (sinh(cotangent) - sinh(a)) is written as a product, which keeps its digits.
  const double projection = std::isinf(cotangent_) ? cosine_
                                                   : 2 * sine_ * std::cosh((cotangent_ + a) / 2) *
                                                         std::sinh((cotangent_ - a) / 2);
  return projection * slopes_.p_da(a);
}

Probability<double> MarginalDistribution::cdf(double a) const {
  if (a > turn_) {
    const double complement = upper_mass(a) / norm_;
    return {1 - complement, complement};
  }
  const double u = lower_mass(-a) / norm_;
  return {u, 1 - u};
}

double MarginalDistribution::quantile(const Probability<double>& u, double guess) const {
  if (u.u == 0) return -kInfinity;
  if (u.complement == 0) return farthest_;
  // The tails are close to straight lines in the logarithm of a mass, so that is solved for.
  const double farthest = std::min(farthest_, kFarthestLow);
  if (u.u * norm_ <= lower_mass(-turn_)) {
    const double target = std::log(u.u * norm_);
    const auto lack = [&](double b) {
      const double mass = lower_mass(b);
      return WithDerivative<double>{target - std::log(mass), weighted_density(-b) / mass};
    };
    return -support::increasing_root(lack, -turn_, kFarthestLow, -guess, kQuantileStep);
  }
  const double target = std::log(u.complement * norm_);
  const auto lack = [&](double a) {
    const double mass = upper_mass(a);
    return WithDerivative<double>{target - std::log(mass), weighted_density(a) / mass};
  };
  return support::increasing_root(lack, turn_, farthest, guess, kQuantileStep);
}

}  // namespace vndf::precompute
