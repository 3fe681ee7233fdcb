// The distribution of the slope y given the slope x.
#include "vndf/precompute/conditional_distribution.h"

#include <algorithm>
#include <boost/math/quadrature/exp_sinh.hpp>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <limits>
#include <vector>

namespace vndf::precompute {
namespace {

using distributions::Estimate;

// Panels are equal in asinh(y / width). Each spans a ratio of exp(1/4) at most, on which Gauss's
// rule with 10 nodes is exact to rounding for smooth densities.
constexpr double kPanel = 0.25;
// The last of so many panels begins at width * exp(50) / 2. Power tails, which fall most slowly,
// end by kNegligible before it.
constexpr std::size_t kMostPanels = 200;
// A density may be singular next to a break. Panels halve towards it this often, down to 1e-9 of
// the distance to the break before.
constexpr int kHalvings = 30;
// Width of the first panel, in units of the scale, where x is 0.
constexpr double kNarrowest = 1e-6;
// The panel that adds less than this, a tenth of a rounding, is the last one.
constexpr double kNegligible = 1e-17;
// The Gauss-Kronrod rule halves a panel at most twice to reach the tolerance, so that a panel next
// to a singular break does not cost without bound.
constexpr double kTolerance = 1e-13;
constexpr unsigned kMostBisections = 2;
// A smaller marginal density counts as none: this leaves 58 decades above the smallest normal
// number for the weights and widths that it is multiplied by.
constexpr double kSmallestDensity = 1e-250;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The integral is taken over [-1, 1], because Boost 1.74 compares the error of that interval with
/// the tolerance that is meant for the given one.
template <class F>
Estimate integrate_panel(const F& f, double low, double high) {
  const double middle = (low + high) / 2, half = (high - low) / 2;
  double error = 0;
  const double value = boost::math::quadrature::gauss_kronrod<double, 15>::integrate(
      [&](double t) { return f(middle + half * t); }, -1.0, 1.0, kMostBisections, kTolerance,
      &error);
  return {half * value, half * error};
}

/// The integral from `last` > 0 to infinity.
template <class F>
Estimate integrate_beyond(const F& f, double last) {
  thread_local boost::math::quadrature::exp_sinh<double> half_line;
  double error = 0;
  const double value = last * half_line.integrate([&](double v) { return f(last * (1 + v)); }, 0.0,
                                                  kInfinity, kTolerance, &error);
  return {value, last * error};
}

/// 0 and the places at which the density along y jumps or has a kink.
std::vector<double> breaks_in_y(const UnitSlopes& slopes, double x, double scale) {
  std::vector<double> places{0};
  for (const double r : slopes.distribution().breaks()) {
    const double radius = r / slopes.mean_slope();
    if (radius > x) places.push_back(std::sqrt((radius - x) * (radius + x)) / scale);
  }
  return places;
}

/// The width over which the density falls off, in units of the scale, 1 where it does not fall; or
/// x, where a cusp of p22 at the centre is rounded off.
double width_of(const UnitSlopes& slopes, double x, double scale) {
  const double natural = slopes.density(x).value / (2 * slopes.p22(x) * scale);
  const double fall = natural > 0 && natural < 1 ? natural : 1;
  return std::min(fall, std::max(x / scale, kNarrowest));
}

/// Edges of panels from 0 to `end`, the last of the breaks, or to beyond all mass if it is
/// infinite.
std::vector<double> panel_edges(const std::vector<double>& breaks, double width, double end) {
  std::vector<double> edges;
  for (std::size_t k = 0; k < kMostPanels; ++k) {
    const double y = width * std::sinh(kPanel * static_cast<double>(k));
    if (y < end) edges.push_back(y);
  }
  for (std::size_t b = 1; b < breaks.size(); ++b) {
    edges.push_back(breaks[b]);
    const double below = breaks[b] - breaks[b - 1];
    for (int k = 1; k <= kHalvings; ++k) {
      edges.push_back(breaks[b] - std::ldexp(below, -k));
      if (breaks[b] < end) edges.push_back(breaks[b] + std::ldexp(below, -k));
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  while (edges.back() > end) edges.pop_back();
  return edges;
}

bool is_bounded(const UnitSlopes& slopes) {
  return std::isfinite(slopes.support());
}

}  // namespace

ConditionalScale<double> plain_scale(const UnitSlopes& slopes) {
  const double r = slopes.support();
  return is_bounded(slopes) ? ConditionalScale<double>{r * r, -1} : ConditionalScale<double>{1, 1};
}

bool ConditionalDistribution::reachable(const UnitSlopes& slopes, double x) {
  return x < slopes.support() && slopes.density(x).value > kSmallestDensity;
}

ConditionalDistribution::ConditionalDistribution(const UnitSlopes& slopes, double x,
                                                 const ConditionalScale<double>& scale)
    : scale_(scale.at({x, 1})),
      bounded_(is_bounded(slopes)),
      cdf_(integrate({&slopes, x, scale_})) {}

double ConditionalDistribution::Density::operator()(double y) const {
  const double s = y * scale;
  return slopes->p22(std::sqrt(x * x + s * s));
}

TabulatedCdf<ConditionalDistribution::Density> ConditionalDistribution::integrate(
    const Density& density) {
  const UnitSlopes& slopes = *density.slopes;
  const bool bounded = is_bounded(slopes);
  const auto breaks = breaks_in_y(slopes, density.x, density.scale);
  auto edges = panel_edges(breaks, width_of(slopes, density.x, density.scale),
                           bounded ? breaks.back() : kInfinity);
  std::vector<Estimate> panels;
  double below = 0;
  for (std::size_t k = 1; k < edges.size(); ++k) {
    panels.push_back(integrate_panel(density, edges[k - 1], edges[k]));
    below += panels.back().value;
    const bool past_breaks = !bounded && edges[k] > breaks.back();
    if (past_breaks && panels.back().value <= kNegligible * below) break;
  }
  edges.resize(panels.size() + 1);
  const Estimate beyond = bounded ? Estimate{0, 0} : integrate_beyond(density, edges.back());
  return {density, std::move(edges), panels, beyond};
}

double ConditionalDistribution::quantile(const Probability<double>& p) const {
  if (p.u == 0) return 0;
  if (p.complement == 0) return bounded_ ? cdf_.last_edge() : kInfinity;
  const double above = p.complement * cdf_.above_first();
  const double guess = cdf_.interpolated_inverse_above(above);
  if (p.complement < 0.5) return cdf_.inverse_above(above, guess);
  return cdf_.inverse_below(p.u * cdf_.above_first(), guess, Rounding::sum);
}

}  // namespace vndf::precompute
