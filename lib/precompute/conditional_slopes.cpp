// The distribution of the slope y given the slope x.
#include "precompute/conditional_slopes.h"

#include <algorithm>
#include <boost/math/quadrature/exp_sinh.hpp>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <limits>

#include "precompute/bracketed_newton.h"

namespace vndf::precompute {
namespace {

// Panels are equal in asinh(y / width): each spans a ratio of exp(1/4) at most, on which Gauss's
// rule with 10 nodes is exact to rounding for smooth densities.
constexpr double kPanel = 0.25;
constexpr double kNegligible = 1e-17;
constexpr double kTolerance = 1e-13;
constexpr unsigned kDepth = 5;
constexpr double kSmallestDensity = 1e-250;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

bool ConditionalSlopes::reachable(const UnitSlopes& slopes, double x) {
  return slopes.density(x).value > kSmallestDensity;
}

ConditionalSlopes::ConditionalSlopes(const UnitSlopes& slopes, double x)
    : slopes_(slopes), x_(x), unit_(std::hypot(1, x)) {
  // The width over which the density falls off, in the units of y; 1 where it does not fall.
  const double width = std::min(1.0, slopes.density(x).value / (2 * slopes.p22(x) * unit_));

  const auto integrand = [this](double y) { return density(y); };
  edge_ = {0};
  head_ = {0};
  std::vector<double> pieces;
  double negligible = 0;
  do {
    const double high = width * std::sinh(kPanel * static_cast<double>(edge_.size()));
    double error = 0;
    pieces.push_back(boost::math::quadrature::gauss_kronrod<double, 15>::integrate(
        integrand, edge_.back(), high, kDepth, kTolerance, &error));
    error_ += error;
    edge_.push_back(high);
    head_.push_back(head_.back() + pieces.back());
    negligible = kNegligible * head_.back();
  } while (pieces.back() > negligible);

  // The rest, to infinity.
  thread_local boost::math::quadrature::exp_sinh<double> half_line;
  const double last = edge_.back();
  double error = 0;
  const double rest = last * half_line.integrate([&](double v) { return density(last * (1 + v)); },
                                                 0.0, kInfinity, kTolerance, &error);
  error_ += last * error;
  tail_.assign(edge_.size(), rest);
  for (std::size_t k = pieces.size(); k-- > 0;) tail_[k] = tail_[k + 1] + pieces[k];
}

double ConditionalSlopes::density(double y) const {
  const double s = y * unit_;
  return slopes_.p22(std::sqrt(x_ * x_ + s * s));
}

double ConditionalSlopes::partial(double low, double high) const {
  return boost::math::quadrature::gauss<double, 10>::integrate(
      [this](double y) { return density(y); }, low, high);
}

std::size_t ConditionalSlopes::panel_of(double y) const {
  const auto above = std::upper_bound(edge_.begin(), edge_.end() - 1, y);
  return static_cast<std::size_t>(above - edge_.begin()) - 1;
}

std::size_t ConditionalSlopes::panel_of(const Probability<double>& q) const {
  const double mass = q.u * total();
  const auto below = std::lower_bound(tail_.begin(), tail_.end() - 1, mass, std::greater<>());
  return std::max<std::size_t>(1, static_cast<std::size_t>(below - tail_.begin())) - 1;
}

Probability<double> ConditionalSlopes::cdf(double y) const {
  // The smaller of the two masses is integrated, so that neither tail is a difference.
  const std::size_t k = panel_of(y);
  const bool last = k + 1 == edge_.size();
  if (tail_[k] < total() / 2) {
    const double q = (last ? tail_[k] : tail_[k + 1] + partial(y, edge_[k + 1])) / total();
    return {q, 1 - q};
  }
  const double complement = (head_[k] + partial(edge_[k], y)) / total();
  return {1 - complement, complement};
}

double ConditionalSlopes::quantile(const Probability<double>& q) const {
  if (q.u == 0) return kInfinity;
  const std::size_t k = panel_of(q);
  const Bracket panel{edge_[k], edge_[k + 1]};
  const double fraction = (tail_[k] - q.u * total()) / (tail_[k] - tail_[k + 1]);
  const double guess = panel.low + fraction * (panel.high - panel.low);
  if (q.u < 0.5)
    return bracketed_newton(
        [&](double y) {
          const double mass = tail_[k + 1] + partial(y, panel.high);
          return ValueAndSlope{mass - q.u * total(), -density(y)};
        },
        panel, guess);
  return bracketed_newton(
      [&](double y) {
        const double mass = head_[k] + partial(panel.low, y);
        return ValueAndSlope{q.complement * total() - mass, -density(y)};
      },
      panel, guess);
}

}  // namespace vndf::precompute
