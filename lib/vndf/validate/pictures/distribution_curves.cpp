// The functions of a distribution as curves.
#include "vndf/validate/pictures/distribution_curves.h"

#include <algorithm>
#include <cmath>

namespace vndf::validate {
namespace {

constexpr double kBeyond = 1e-6;
constexpr double kSteepest = 89.5;  // degrees

Vec3<double> direction(double degrees) {
  return at_angles(degrees, 0, 1, 1).wi;
}

/// Radius beyond which kBeyond of the slopes lie.
double farthest_radius(const ExactSlopes& exact) {
  const auto& slopes = exact.unit_slopes();
  if (std::isfinite(slopes.support())) return slopes.support() * slopes.mean_slope();
  double low = 0, high = std::asinh(1e12);  // units of the mean slope
  for (int k = 0; k < 60; ++k) {
    const double middle = (low + high) / 2;
    (exact.all_radii().cdf(middle).complement > kBeyond ? low : high) = middle;
  }
  return std::sinh(high) * slopes.mean_slope();
}

double d_of(const SamplerUnderTest& sampler, double alpha, const Vec3<double>& wm) {
  double d = 0;
  sampler.d(Alpha<double>{alpha, alpha}, {&wm, 1}, {&d, 1});
  return d;
}

Curve p22_curve(const SamplerUnderTest& sampler, std::size_t places) {
  const ExactSlopes& exact = *sampler.exact;
  const double mu = exact.unit_slopes().mean_slope(), low = mu / 100, high = farthest_radius(exact);
  Curve curve{.alpha = 1};
  for (std::size_t k = 0; k < places; ++k) {
    const double r =
        low * std::pow(high / low, (static_cast<double>(k) + 0.5) / static_cast<double>(places));
    // Single-precision directions are given as they are, and D is that of the one given.
    const double length = std::hypot(r, 1);
    const Vec3<double> wm{to_single(-r / length), 0, to_single(1 / length)};
    const double z2 = wm.z * wm.z, at = -wm.x / wm.z;
    curve.at.push_back(at);
    curve.exact.push_back(exact.unit_slopes().p22(at / mu) / (mu * mu));
    curve.sampler.push_back(d_of(sampler, 1, wm) * z2 * z2);
  }
  return curve;
}

/// `exact` and `own` of directions from `first` degrees on.
template <class Exact, class Own>
Curve angle_curve(double alpha, double first, std::size_t places, Exact exact, Own own) {
  Curve curve{.alpha = alpha};
  for (std::size_t k = 0; k < places; ++k) {
    const double theta =
        first + (kSteepest - first) * (static_cast<double>(k) / static_cast<double>(places - 1));
    const Vec3<double> w = direction(theta);
    curve.at.push_back(theta);
    curve.exact.push_back(exact(w));
    curve.sampler.push_back(own(w));
  }
  return curve;
}

}  // namespace

DistributionCurves distribution_curves(const SamplerUnderTest& sampler,
                                       const std::vector<double>& roughnesses, std::size_t places) {
  const ExactSlopes& exact = *sampler.exact;
  DistributionCurves curves{p22_curve(sampler, places), {}, {}};
  for (const double a : roughnesses) {
    const double single = to_single(a);
    const Alpha<double> alpha{single, single};
    curves.lambda.push_back(angle_curve(
        a, 90 - kSteepest, places, [&](const auto& w) { return exact.lambda(w, alpha); },
        [&](const auto& w) {
          return sampler.lambda({w, alpha});
        }));
    curves.d.push_back(angle_curve(
        a, 0, places, [&](const auto& w) { return exact.d(w, alpha); },
        [&](const auto& w) { return d_of(sampler, single, w); }));
  }
  return curves;
}

}  // namespace vndf::validate
