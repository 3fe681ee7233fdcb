// A slope distribution brought to unit mass and unit mean slope.
#include "precompute/unit_slopes.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace vndf::precompute {
namespace {

constexpr std::size_t kNodes = 8192;
// A power tail is straight in log Q over asinh(x) to x^-2, below rounding at sinh(20) = 2.4e8. A
// light tail is followed until it is smaller than any probability that can matter.
constexpr double kFarthestAsinh = 20;
constexpr double kSmallestTail = 1e-250;
constexpr double kSmallestProbability = 1e-12;

struct Node {
  Estimate p, q, m;
};

double relative_error(const Estimate& e) {
  return e.error / e.value;
}

}  // namespace

UnitSlopes::UnitSlopes(const SlopeDistribution& d, const Workers& workers)
    : distribution_(d),
      mass_(slope_mass(d).value),
      mean_slope_(vndf::precompute::mean_slope(d, mass_).value) {
  const auto tail_at = [&](double a) {
    return vndf::precompute::upper_tail(d, mean_slope_ * std::sinh(a)).value;
  };
  double end = kFarthestAsinh;
  while (!(tail_at(end) > kSmallestTail * mass_)) end *= 0.98;

  const double step = end / (kNodes - 1);
  std::vector<LogCurveNode<double>> log_q(kNodes), log_m(kNodes);
  std::vector<double> errors(kNodes);
  parallel_for(kNodes, {workers.threads}, [&](std::size_t k) {
    const double a = step * static_cast<double>(k);
    const double x = mean_slope_ * std::sinh(a);
    const Node n{marginal_density(d, x), vndf::precompute::upper_tail(d, x), partial_moment(d, x)};
    const double dx = mean_slope_ * std::cosh(a) * step;  // per node
    log_q[k] = {std::log(n.q.value / mass_), -n.p.value / n.q.value * dx};
    log_m[k] = {std::log(n.m.value / (mass_ * mean_slope_)), -x * n.p.value / n.m.value * dx};
    if (n.q.value > kSmallestProbability * mass_)
      errors[k] = std::max({relative_error(n.p), relative_error(n.q), relative_error(n.m)});
  });
  quadrature_error_ = *std::max_element(errors.begin(), errors.end());
  log_q_ = {step, std::move(log_q)};
  log_m_ = {step, std::move(log_m)};
}

Estimate UnitSlopes::density(double x) const {
  const Estimate p = marginal_density(distribution_, x * mean_slope_);
  const double scale = mean_slope_ / mass_;
  return {p.value * scale, p.error * scale};
}

Estimate UnitSlopes::upper_tail(double x) const {
  const Estimate q = vndf::precompute::upper_tail(distribution_, x * mean_slope_);
  return {q.value / mass_, q.error / mass_};
}

Estimate UnitSlopes::backfacing(double c) const {
  const Estimate b = vndf::precompute::backfacing(distribution_, c * mean_slope_);
  const double scale = 1 / (mass_ * mean_slope_);
  return {b.value * scale, b.error * scale};
}

}  // namespace vndf::precompute
