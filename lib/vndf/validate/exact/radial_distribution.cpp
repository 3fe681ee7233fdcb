// The distribution of the radius of a visible slope.
#include "vndf/validate/exact/radial_distribution.h"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>

#include "vndf/log_curve.h"
#include "vndf/precompute/asinh_slope.h"

namespace vndf::validate {
namespace {

using precompute::asinh_of;
using precompute::UnitSlopes;

constexpr std::size_t kPanels = 4096;   // of each segment, crowded at both of its ends
constexpr double kFarthestAsinh = 100;  // sinh(100) = 1.3e43: beyond single precision
constexpr double kNegligible = 1e-80;   // mass that is left out of a light tail
constexpr double kWide = 0.5;           // panels of radial_cdf in asinh(r)
constexpr Grading kGrading = Grading::both;

/// Where the panels end: everything, or what a light tail has.
double farthest(const UnitSlopes& slopes) {
  double a = std::asinh(slopes.support());
  if (std::isfinite(a)) return a;
  for (a = kFarthestAsinh; slopes.m(a) < kNegligible && a > 1e-3;) a *= 0.98;
  return a;
}

/// Ends of the segments between which the integrand is smooth: breaks of p22 and the cotangent.
std::vector<double> smooth_ends(const UnitSlopes& slopes, double cotangent) {
  const double end = farthest(slopes);
  std::vector<double> ends{0, end, cotangent};
  for (const double r : slopes.distribution().breaks())
    ends.push_back(std::asinh(r / slopes.mean_slope()));
  std::sort(ends.begin(), ends.end());
  std::vector<double> kept{0};
  for (const double e : ends)
    if (e > kept.back() && e <= end) kept.push_back(e);
  return kept;
}

template <unsigned Points, class F>
double gauss(F f, double low, double high) {
  return boost::math::quadrature::gauss<double, Points>::integrate(f, low, high);
}

/// p22 r A(r) dr / da at a = asinh(r).
double visible_density(const UnitSlopes& slopes, double cosine, double sine, double a) {
  const double r = std::sinh(a);
  const double p22 = slopes.p22(r);
  if (!(p22 > 0)) return 0;
  return p22 * r * 2 * angular_mass(cosine, sine, r, 1).half * std::cosh(a);
}

}  // namespace

AngularMass angular_mass(double cosine, double sine, double h, double w) {
  constexpr double kPi = std::numbers::pi;
  const double vertical = cosine * w, horizontal = sine * h;
  if (vertical >= horizontal) return {0, vertical * kPi};
  if (vertical <= -horizontal) return {kPi, 0};
  if (vertical < 0) {
    // The half that is seen is narrow, and the angle to its edge keeps the digits.
    const double seen = 2 * std::asin(std::sqrt((horizontal + vertical) / (2 * horizontal)));
    return {kPi - seen, horizontal * (std::sin(seen) - seen * std::cos(seen))};
  }
  const double phi0 = std::acos(vertical / horizontal);
  const double reach = std::sqrt((horizontal - vertical) * (horizontal + vertical));
  return {phi0, vertical * (kPi - phi0) + reach};
}

RadialDistribution::RadialDistribution(const UnitSlopes& slopes, const BoundedSlope<double>& c)
    : slopes_(&slopes),
      cosine_(c.numerator() / c.hypotenuse()),
      sine_(c.denominator() / c.hypotenuse()) {
  const auto ends = smooth_ends(slopes, std::abs(asinh_of(c)));
  for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
    segments_.push_back({ends[k], ends[k + 1], {}});
    fill(segments_.back());
  }
  beyond_ = mass_beyond(ends.back());
  sum_up();
}

double RadialDistribution::density(double a) const {
  return visible_density(*slopes_, cosine_, sine_, a);
}

void RadialDistribution::fill(Segment& segment) const {
  const double width = segment.end - segment.begin;
  const auto per_t = [&](double t) {
    const double a = segment.begin + width * graded_inverse(t, kGrading);
    return density(a) * graded_inverse_derivative(t, kGrading) * width;
  };
  segment.nodes.resize(kPanels + 1);
  constexpr double kStep = 1.0 / kPanels;
  for (std::size_t k = 0; k < kPanels; ++k) {
    const double t = static_cast<double>(k) * kStep;
    Node& node = segment.nodes[k];
    node.head = gauss<7>(per_t, t, t + kStep);  // of the panel after it, until sum_up()
    // Both gradings have dz/dt = 0 at the ends, where the density itself may have no value.
    node.slope = k == 0 ? 0 : per_t(t) * kStep;
  }
}

double RadialDistribution::mass_beyond(double a) const {
  if (std::isfinite(slopes_->support())) return 0;
  constexpr double kBack = 0.01;
  const double here = density(a), before = density(a - kBack);
  if (!(here > 0)) return 0;
  return here / (std::log(before / here) / kBack);  // a power tail falls like exp(-kappa a)
}

void RadialDistribution::sum_up() {
  // Both sums are of positive terms, so neither tail is a difference.
  double tail = beyond_;
  for (auto s = segments_.rbegin(); s != segments_.rend(); ++s)
    for (auto node = s->nodes.rbegin(); node != s->nodes.rend(); ++node)
      node->tail = tail += node->head;
  visible_area_ = tail;
  double head = 0;
  for (Segment& s : segments_)
    for (Node& node : s.nodes) {
      const double panel = node.head;
      node.head = head / visible_area_;
      node.tail /= visible_area_;
      node.slope /= visible_area_;
      head += panel;
    }
}

Probability<double> RadialDistribution::cdf(double a) const {
  const Segment& last = segments_.back();
  if (a >= last.end) {
    if (beyond_ == 0) return {1, 0};
    const double kappa = density(last.end) / beyond_;
    const double tail = last.nodes.back().tail * std::exp(-kappa * (a - last.end));
    return {1 - tail, tail};
  }
  auto s = segments_.begin();
  while (a > s->end) ++s;
  const double scaled = graded((a - s->begin) / (s->end - s->begin), kGrading) * kPanels;
  const std::size_t k = std::min(static_cast<std::size_t>(scaled), kPanels - 1);
  const double f = scaled - static_cast<double>(k);
  const Node &l = s->nodes[k], &r = s->nodes[k + 1];
  // The cubic through both nodes with their slopes, as mass above the left and below the right one.
  const double mass = l.head < 0.5 ? r.head - l.head : l.tail - r.tail;
  const double above =
      f * (l.slope + f * (3 * mass - 2 * l.slope - r.slope + f * (l.slope + r.slope - 2 * mass)));
  if (l.head < 0.5) {
    const double head = std::max(l.head + above, 0.0);
    return {head, 1 - head};
  }
  const double tail = std::max(r.tail + (mass - above), 0.0);
  return {1 - tail, tail};
}

Probability<double> radial_cdf(const UnitSlopes& slopes, const RadialDistribution& all,
                               const BoundedSlope<double>& c, double a) {
  const double cosine = c.numerator() / c.hypotenuse(), sine = c.denominator() / c.hypotenuse();
  const double cotangent = std::abs(asinh_of(c));
  // From above all facets below the cotangent are visible from every side, from below none is.
  const double hidden =
      std::isinf(cotangent) ? 0 : sine * slopes.backfacing(std::abs(c.slope())).value;
  const double area = std::max(cosine, 0.0) + hidden;
  const double below = std::max(cosine, 0.0) * all.cdf(std::min(a, cotangent)).u;
  if (a <= cotangent) return {below / area, 1 - below / area};
  const auto f = [&](double t) { return visible_density(slopes, cosine, sine, t); };
  const auto ends = smooth_ends(slopes, cotangent);
  double sum = below;
  for (double low = cotangent; low < std::min(a, ends.back());) {
    const double next_end = *std::upper_bound(ends.begin(), ends.end(), low);
    const double high = std::min({low + kWide, next_end, a});
    // The integrand leaves the cotangent like a square root's integral.
    const double step = high - low;
    sum += low == cotangent
               ? gauss<15>([&](double s) { return 2 * s * step * f(low + step * s * s); }, 0.0, 1.0)
               : gauss<15>(f, low, high);
    low = high;
  }
  const double u = std::min(1.0, sum / area);
  return {u, 1 - u};
}

}  // namespace vndf::validate
