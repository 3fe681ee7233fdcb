// The distribution of the slope y given the slope x.
#include "vndf/precompute/conditional_distribution.h"

#include <algorithm>
#include <boost/math/quadrature/exp_sinh.hpp>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <functional>
#include <limits>

#include "vndf/precompute/bracketed_newton.h"

namespace vndf::precompute {
namespace {

// Panels are equal in asinh(y / width): each spans a ratio of exp(1/4) at most, on which Gauss's
// rule with 10 nodes is exact to rounding for smooth densities.
constexpr double kPanel = 0.25;
constexpr std::size_t kPanels = 200;  // at most; the last begins at width * exp(50) / 2
// Next to a break, where a density may be singular, panels halve this often.
constexpr int kHalvings = 30;
constexpr double kNarrowest = 1e-6;
constexpr double kNegligible = 1e-17;
constexpr double kTolerance = 1e-13;
constexpr unsigned kDepth = 2;
constexpr double kSmallestDensity = 1e-250;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Over [-1, 1]: Boost 1.74 compares the error of that interval with a tolerance for the given one.
template <class F>
distributions::Estimate integrate_panel(F f, double low, double high) {
  const double middle = (low + high) / 2, half = (high - low) / 2;
  double error = 0;
  const double value = boost::math::quadrature::gauss_kronrod<double, 15>::integrate(
      [&](double t) { return f(middle + half * t); }, -1.0, 1.0, kDepth, kTolerance, &error);
  return {half * value, half * error};
}

}  // namespace

ConditionalScale<double> plain_scale(const UnitSlopes& slopes) {
  const double r = slopes.support();
  return std::isfinite(r) ? ConditionalScale<double>{r * r, -1} : ConditionalScale<double>{1, 1};
}

bool ConditionalDistribution::reachable(const UnitSlopes& slopes, double x) {
  return x < slopes.support() && slopes.density(x).value > kSmallestDensity;
}

ConditionalDistribution::ConditionalDistribution(const UnitSlopes& slopes, double x,
                                                 const ConditionalScale<double>& scale)
    : slopes_(slopes), bounded_(std::isfinite(slopes.support())), x_(x), scale_(scale.at({x, 1})) {
  // The width over which the density falls off, in units of the scale, 1 where it does not fall; or
  // x, where a cusp of p22 at the centre is rounded off.
  const double natural = slopes.density(x).value / (2 * slopes.p22(x) * scale_);
  const double fall = natural > 0 && natural < 1 ? natural : 1;
  const double width = std::min(fall, std::max(x / scale_, kNarrowest));

  const auto integrand = [this](double y) { return density(y); };
  const auto edges = panel_edges(width);
  edge_ = {0};
  head_ = {0};
  std::vector<double> pieces;
  for (std::size_t k = 1; k < edges.size(); ++k) {
    const distributions::Estimate piece = integrate_panel(integrand, edges[k - 1], edges[k]);
    pieces.push_back(piece.value);
    error_ += piece.error;
    edge_.push_back(edges[k]);
    head_.push_back(head_.back() + pieces.back());
    const bool past_breaks = !bounded_ && edges[k] > breaks_in_y().back();
    if (past_breaks && pieces.back() <= kNegligible * head_.back()) break;
  }
  tail_.assign(edge_.size(), bounded_ ? 0 : rest());
  for (std::size_t k = pieces.size(); k-- > 0;) tail_[k] = tail_[k + 1] + pieces[k];
}

/// The integral beyond the last panel, to infinity.
double ConditionalDistribution::rest() {
  thread_local boost::math::quadrature::exp_sinh<double> half_line;
  const double last = edge_.back();
  double error = 0;
  const double value = last * half_line.integrate([&](double v) { return density(last * (1 + v)); },
                                                  0.0, kInfinity, kTolerance, &error);
  error_ += last * error;
  return value;
}

/// 0 and the places at which the density along y jumps or has a kink.
std::vector<double> ConditionalDistribution::breaks_in_y() const {
  std::vector<double> places{0};
  for (const double r : slopes_.distribution().breaks()) {
    const double radius = r / slopes_.mean_slope();
    if (radius > x_) places.push_back(std::sqrt((radius - x_) * (radius + x_)) / scale_);
  }
  return places;
}

std::vector<double> ConditionalDistribution::panel_edges(double width) const {
  const auto breaks = breaks_in_y();
  const double end = bounded_ ? breaks.back() : kInfinity;
  std::vector<double> edges;
  for (std::size_t k = 0; k < kPanels; ++k) {
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

double ConditionalDistribution::density(double y) const {
  const double s = y * scale_;
  return slopes_.p22(std::sqrt(x_ * x_ + s * s));
}

double ConditionalDistribution::partial(double low, double high) const {
  return boost::math::quadrature::gauss<double, 10>::integrate(
      [this](double y) { return density(y); }, low, high);
}

std::size_t ConditionalDistribution::panel_of(double y) const {
  const auto above = std::upper_bound(edge_.begin(), edge_.end() - 1, y);
  return static_cast<std::size_t>(above - edge_.begin()) - 1;
}

std::size_t ConditionalDistribution::panel_of_tail(double mass) const {
  const auto below = std::lower_bound(tail_.begin(), tail_.end() - 1, mass, std::greater<>());
  return std::max<std::size_t>(1, static_cast<std::size_t>(below - tail_.begin())) - 1;
}

Probability<double> ConditionalDistribution::cdf(double y) const {
  // The smaller of the two masses is integrated, so that neither tail is a difference.
  const std::size_t k = panel_of(y);
  const bool last = k + 1 == edge_.size();
  if (tail_[k] < total() / 2) {
    const double tail = (last ? tail_[k] : tail_[k + 1] + partial(y, edge_[k + 1])) / total();
    return {1 - tail, tail};
  }
  const double head = (head_[k] + partial(edge_[k], y)) / total();
  return {head, 1 - head};
}

/// The place in panel k beyond which lies the mass `tail`, by Hermite interpolation of y over the
/// mass: good to some 1e-4 of the panel.
double ConditionalDistribution::inverse_hermite(std::size_t k, double tail) const {
  const double mass = tail_[k] - tail_[k + 1], width = edge_[k + 1] - edge_[k];
  const double f = (tail_[k] - tail) / mass;
  // Slopes dy / df of more than three times the secant would make the curve turn back.
  const double m0 = std::min(3 * width, mass / density(edge_[k]));
  const double m1 = std::min(3 * width, mass / density(edge_[k + 1]));
  return edge_[k] + f * (m0 + f * (3 * width - 2 * m0 - m1 + f * (m0 + m1 - 2 * width)));
}

double ConditionalDistribution::quantile(const Probability<double>& p) const {
  if (p.u == 0) return 0;
  if (p.complement == 0) return bounded_ ? edge_.back() : kInfinity;
  const double tail = p.complement * total();
  const std::size_t k = panel_of_tail(tail);
  const Bracket panel{edge_[k], edge_[k + 1]};
  const double guess = inverse_hermite(k, tail);
  if (p.complement < 0.5)
    return bracketed_newton(
        [&](double y) {
          const double mass = tail_[k + 1] + partial(y, panel.high);
          return ValueAndSlope{mass - tail, -density(y)};
        },
        panel, guess);
  return bracketed_newton(
      [&](double y) {
        const double mass = head_[k] + partial(panel.low, y);
        return ValueAndSlope{p.u * total() - mass, -density(y)};
      },
      panel, guess);
}

}  // namespace vndf::precompute
