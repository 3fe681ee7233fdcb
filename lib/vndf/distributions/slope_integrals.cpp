// P, Q, M and B by double-exponential quadrature, piece by piece between the breaks of p22.
#include "vndf/distributions/slope_integrals.h"

#include <algorithm>
#include <boost/math/quadrature/exp_sinh.hpp>
#include <boost/math/quadrature/tanh_sinh.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "vndf/support/text.h"

namespace vndf::distributions {
namespace {

constexpr char kDoesNotConverge[] =
    " does not converge; where p22 jumps or has a kink, the radius must be among its breaks";
// The double-exponential rule reaches the rounding of the integrals; a smaller tolerance would make
// it halve its steps in vain.
constexpr double kRelativeTolerance = 1e-13;
// Where a density falls is only needed to place a cut, so it is found to 1 %. A density that has
// not fallen at a slope of 1e12 does not drop sharply.
constexpr double kFarthestFall = 1e12, kFallResolution = 0.01;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// One rule per thread: Boost 1.74 declares integrate() without const.
boost::math::quadrature::exp_sinh<double>& half_line() {
  thread_local boost::math::quadrature::exp_sinh<double> rule;
  return rule;
}
boost::math::quadrature::tanh_sinh<double>& interval() {
  thread_local boost::math::quadrature::tanh_sinh<double> rule;
  return rule;
}

/// int_from^inf f(s) ds. The rule crowds its nodes around s = from + scale.
template <class F>
Estimate integrate_to_infinity(F f, double from, double scale) {
  double error = 0;
  const double value = half_line().integrate([&](double v) { return f(from + scale * v); }, 0.0,
                                             kInfinity, kRelativeTolerance, &error);
  return {scale * value, scale * error};
}

template <class F>
Estimate integrate_between(F f, double low, double high) {
  double error = 0;
  const double value = interval().integrate(f, low, high, kRelativeTolerance, &error);
  return {value, error};
}

/// The radius closest to `r` that lies strictly between two breaks, so that rounding does not put a
/// node at the end of a piece on the other side of a jump.
double inside(double r, double low, double high) {
  return std::clamp(r, std::nextafter(low, kInfinity), std::nextafter(high, 0));
}

/// Where an integral along s is cut: at s the radius is a break r of p22, or it is cut for the sake
/// of the rules and r is that of the break before it.
struct Cut {
  double s, r;
};

/// int_0^inf f(s, r_low, r_high) ds of a function that is smooth between the cuts, which bound the
/// radius by r_low and r_high, and 0 beyond the last of them if it is `bounded`.
template <class F>
Estimate integrate(F f, double from_radius, const std::vector<Cut>& cuts, bool bounded,
                   double scale) {
  Estimate sum{0, 0};
  const auto add = [&](const Estimate& e) { sum = {sum.value + e.value, sum.error + e.error}; };
  Cut low{0, from_radius};
  for (const Cut& high : cuts) {
    const double r_high = high.r > low.r ? high.r : kInfinity;
    if (high.s > low.s)
      add(integrate_between([&](double s) { return f(s, low.r, r_high); }, low.s, high.s));
    low = high;
  }
  if (!bounded)
    add(integrate_to_infinity([&](double s) { return f(s, low.r, kInfinity); }, low.s, scale));
  return sum;
}

/// s at which `f` has fallen from f(0) to exp(-e_folds) of it, to a hundredth.
template <class F>
double fallen_at(F f, double e_folds) {
  const double level = f(0.0) * std::exp(-e_folds);
  double low = 0, high = 1;
  while (f(high) > level && high < kFarthestFall) low = high, high *= 2;
  while (high - low > kFallResolution * high) {
    const double middle = (low + high) / 2;
    (f(middle) > level ? low : high) = middle;
  }
  return high;
}

/// Where a density along s drops so sharply that a rule for the half line would spend its nodes on
/// the edge. The integral is cut there, because either side is easy. Returns nothing for a density
/// that falls more slowly.
template <class F>
std::vector<double> sharp_drop(F density) {
  constexpr double kSharp = 2;  // the ratio for exp(-s^3)
  const double edge = fallen_at(density, 1), gone = fallen_at(density, 8);
  if (!(gone < kSharp * edge)) return {};
  return {edge};
}

/// 2 int weight(s) p22(sqrt(x^2 + s^2)) ds.
template <class Weight>
Estimate over_column(const SlopeDistribution& d, double x, Weight weight) {
  std::vector<Cut> cuts;
  for (const double r : d.breaks())
    if (r > x) cuts.push_back({std::sqrt((r - x) * (r + x)), r});
  const bool bounded = std::isfinite(d.support());
  if (cuts.empty() && !bounded)
    for (const double s : sharp_drop([&](double at) { return d.p22(std::hypot(x, at)); }))
      cuts.push_back({s, x});
  const auto [value, error] = integrate(
      [&](double s, double r_low, double r_high) {
        const double density = d.p22(inside(std::hypot(x, s), r_low, r_high));
        return density == 0 ? 0.0 : weight(s) * density;  // a weight may overflow where p22 is 0
      },
      x, cuts, bounded, 1 + x);
  return {2 * value, 2 * error};
}

/// 1 - atan(z) / z, by its series where the difference would cancel: the first term left out is
/// z^18/19 < 1e-18.
double one_minus_atan_ratio(double z) {
  if (z > 0.1) return 1 - std::atan(z) / z;
  const double q = z * z;
  double sum = 0;
  for (int k = 8; k >= 1; --k) sum = (k % 2 == 1 ? 1.0 : -1.0) / (2 * k + 1) + q * sum;
  return q * sum;
}

[[noreturn]] void fail(const SlopeDistribution& d, const std::string& why) {
  throw std::domain_error("distribution " + support::quoted(d.name()) + ": " + why);
}

double checked_p22(const SlopeDistribution& d, double r) {
  const double density = d.p22(r);
  if (density >= 0 && std::isfinite(density)) return density;
  fail(d, "p22 is " + support::rounded_text(density) + " at slope radius " +
              support::rounded_text(r) + "; it must be finite and >= 0");
}

/// Boost reports divergence by an exception, by a value that is not finite or by an error estimate
/// as large as the value.
template <class F>
Estimate convergent(const SlopeDistribution& d, const std::string& what, F f) {
  constexpr double kUsableError = 1e-6;
  Estimate result{};
  try {
    std::vector<Cut> cuts;
    for (const double r : d.breaks()) cuts.push_back({r, r});
    result = integrate([&](double s, double low, double high) { return f(inside(s, low, high)); },
                       0, cuts, std::isfinite(d.support()), 1);
  } catch (const boost::math::evaluation_error&) {
    throw DivergentIntegral("distribution " + support::quoted(d.name()) + ": " + what +
                            kDoesNotConverge);
  }
  if (!std::isfinite(result.value) || !(result.error <= kUsableError * std::abs(result.value)))
    throw DivergentIntegral("distribution " + support::quoted(d.name()) + ": " + what +
                            kDoesNotConverge);
  return result;
}

}  // namespace

Estimate slope_mass(const SlopeDistribution& d) {
  if (const auto known = d.marginals(0)) return {2 * known->q, 0};
  const auto ring = [&](double r) { return 2 * std::numbers::pi * r * checked_p22(d, r); };
  const Estimate mass = convergent(d, "the integral of p22 over the slope plane", ring);
  if (!(mass.value > 0)) fail(d, "p22 is zero everywhere");
  return mass;
}

Estimate mean_slope(const SlopeDistribution& d, double mass) {
  if (const auto known = d.marginals(0)) return {2 * known->m / mass, 0};
  // E|X| = E[r] 2 / pi for a radial density.
  const auto moment = [&](double r) { return 4 * r * r * d.p22(r) / mass; };
  return convergent(d, "the mean slope (no visible normals exist where it is infinite)", moment);
}

Estimate marginal_density(const SlopeDistribution& d, double x) {
  return over_column(d, x, [](double) { return 1.0; });
}

Estimate upper_tail(const SlopeDistribution& d, double x) {
  return over_column(d, x, [x](double s) { return s * std::atan2(s, x); });
}

Estimate partial_moment(const SlopeDistribution& d, double x) {
  return over_column(d, x, [](double s) { return s * s; });
}

Estimate backfacing(const SlopeDistribution& d, double c) {
  return over_column(
      d, c, [c](double s) { return c == 0 ? s * s : s * s * one_minus_atan_ratio(s / c); });
}

MarginalEstimates marginals(const SlopeDistribution& d, double x) {
  if (const auto known = d.marginals(x)) return {{known->p, 0}, {known->q, 0}, {known->m, 0}};
  return {marginal_density(d, x), upper_tail(d, x), partial_moment(d, x)};
}

}  // namespace vndf::distributions
