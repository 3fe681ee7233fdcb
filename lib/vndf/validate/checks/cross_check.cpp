// Cross-check: the sampler beside the exact monotone map.
#include "vndf/validate/checks/cross_check.h"

#include <algorithm>
#include <cmath>

#include "vndf/precompute/marginal_distribution.h"
#include "vndf/support/text.h"
#include "vndf/validate/checks/configurations.h"
#include "vndf/validate/checks/worst_over.h"
#include "vndf/validate/exact/exact_conditional.h"
#include "vndf/validate/statistics/quasi_random.h"

namespace vndf::validate {
namespace {

using precompute::MarginalDistribution;

// The step of the derivative is the error that is allowed, but at most this: a larger one would not
// measure the slope at the point.
constexpr double kLargestStep = 1e-3;

struct Difference {
  Worst u, angle;

  void see(const Difference& o) { see_each(std::tie(u, angle), std::tie(o.u, o.angle)); }
};

double angle_between(const Vec3<double>& a, const Vec3<double>& b) {
  const Vec3<double> across{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  return std::atan2(std::sqrt(dot(across, across)), dot(a, b));
}

/// The difference of two normals, given as their uniform numbers.
double difference(const Uniforms& a, const Uniforms& b) {
  // The ends of w_phi are one azimuth; what counts is the mass that is swept within the radius.
  const double turn = std::abs(a.phi - b.phi);
  const double swept = std::min(turn, 1 - turn) * std::max(a.r, b.r);
  return std::max({std::abs(a.r - b.r), std::abs(a.x - b.x), swept});
}

/// By how much an error of 1 in u1 and one in u2 together move the uniform numbers, at least 1. The
/// radius can move by many times the error of its slope x, where less mass lies beyond that slope
/// than beyond the radius. It is measured by differences from `here`, the uniform numbers at `u`,
/// over a `step` towards the middle.
double condition_number(const SamplerUnderTest& sampler, const Configuration& c,
                        const ExactDistribution& distribution, const RandomPair& u,
                        const Uniforms& here, double step) {
  const auto uniforms = [&](double u1, double u2) {
    return distribution.uniforms(exact_normal(*sampler.exact, c, u1, u2), 0);
  };
  const auto moved = [&](double p) { return p < 0.5 ? p + step : p - step; };
  const double made =
      difference(here, uniforms(moved(u.x), u.y)) + difference(here, uniforms(u.x, moved(u.y)));
  return std::max(1.0, made / step);
}

Difference compare(const SamplerUnderTest& sampler, const Configuration& c, std::size_t points) {
  const ExactDistribution distribution(*sampler.exact, sampler.claims.normals, c);
  const double step = std::min(sampler.bounds_at(c).u_error, kLargestStep);
  Difference worst;
  for (std::size_t k = 0; k < points; ++k) {
    const RandomPair u = quasi_random_point(k);
    const Vec3<double> exact = exact_normal(*sampler.exact, c, u.x, u.y);
    const Vec3<double> given = sampler.sample_one(c, u.x, u.y);
    if (given.z < kSmallestHeight || exact.z < kSmallestHeight) continue;
    const Place place = place_of(c, u.x, u.y);
    const Uniforms here = distribution.uniforms(exact, 0);
    const double moved = difference(here, distribution.uniforms(given, 0));
    worst.u.see(moved / condition_number(sampler, c, distribution, u, here, step), place);
    worst.angle.see(angle_between(exact, given), place);
  }
  return worst;
}

}  // namespace

Vec3<double> exact_normal(const ExactSlopes& exact, const Configuration& c, double u1, double u2) {
  const StretchedFrame frame(exact, c);
  const auto& slopes = exact.unit_slopes();
  const double a = MarginalDistribution(slopes, frame.cotangent()).quantile({u1, 1 - u1}, 0);
  const double x = std::sinh(a);
  const double y = ExactConditional::is_checked(slopes, x)
                       ? ExactConditional(slopes, x).quantile({u2, 1 - u2})
                       : 0;
  return frame.normal_of({x, y, 1});
}

std::vector<CheckResult> cross_check(const SamplerUnderTest& sampler, std::size_t points,
                                     const support::Workers& workers) {
  auto list = check_configurations(sampler);
  std::erase_if(list, [&](const Configuration& c) { return !sampler.claims.inverse_at(c); });
  return on_both_sides(sampler, list, [&](const Side& side) {
    const Difference all = worst_over(
        side.list, workers, [&](const Configuration& c) { return compare(sampler, c, points); });
    CheckResult f = all.u.result("cross-check", "difference in u", side.bounds.u_error);
    f.note = "angle up to " + support::rounded_text(all.angle.measured) + " rad";
    return std::vector{f};
  });
}

}  // namespace vndf::validate
