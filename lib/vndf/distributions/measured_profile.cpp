// A slope distribution given by samples of its radial density.
#include "vndf/distributions/measured_profile.h"

#include <algorithm>
#include <boost/math/quadrature/exp_sinh.hpp>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>
#include <utility>

#include "vndf/support/text.h"

namespace vndf::distributions {
namespace {

// The tail is fitted to the last sixteenth of the samples, so that it follows the end of a profile
// and not its shoulder, but to four at least, so that one noisy sample does not decide it.
constexpr std::size_t kFewestTailSamples = 4, kTailShare = 16;
// A tail falls by at least this many powers of e, and at most, over a radius as large as the last.
// Of a flatter one 0.999 of the mass would be a guess, and a steeper one is an edge.
constexpr double kFlattestTail = 0.05, kSteepestTail = 1e6;
// The double-exponential rule reaches the rounding of the integrals; a smaller tolerance would make
// it halve its steps in vain.
constexpr double kTolerance = 1e-13;
// An x below this part of the interval counts as 0, where atan(s / x) has no more than a kink.
constexpr double kTiny = 1e-9;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

using Rule = boost::math::quadrature::gauss<double, 10>;

/// Calls f(place, weight) at the nodes of the rule over [low, high].
template <class F>
void for_each_node(double low, double high, F f) {
  const double middle = (low + high) / 2, half = (high - low) / 2;
  for (std::size_t k = 0; k < Rule::abscissa().size(); ++k)
    for (const double side : {-1, 1})
      f(middle + side * half * Rule::abscissa()[k], half * Rule::weights()[k]);
}

struct Line {
  double slope, residual;
};

Line least_squares(std::span<const double> x, std::span<const double> y) {
  const auto n = static_cast<double>(x.size());
  double mean_x = 0, mean_y = 0, xx = 0, xy = 0, square = 0;
  for (std::size_t i = 0; i < x.size(); ++i) mean_x += x[i] / n, mean_y += y[i] / n;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mean_x) * (x[i] - mean_x);
    xy += (x[i] - mean_x) * (y[i] - mean_y);
  }
  const double slope = xy / xx;
  for (std::size_t i = 0; i < x.size(); ++i)
    square += std::pow(y[i] - mean_y - slope * (x[i] - mean_x), 2);
  return {slope, std::sqrt(square / n)};
}

/// Slope at the end of the parabola through three points: steps h and secants s of its last
/// interval and of the one before.
double parabola_end(double h, double h_before, double s, double s_before) {
  return s + (s - s_before) * h / (h + h_before);
}

/// The cubic between two knots stays within their values if no slope there has the other sign or is
/// steeper than three times the secant (de Boor and Swartz 1977).
double limited(double slope, double secant) {
  if (!(slope * secant > 0)) return 0;
  return std::copysign(std::min(std::abs(slope), 3 * std::abs(secant)), secant);
}

/// Slopes of the C2 cubic spline with the slopes `first` and `last` at its ends: Thomas's algorithm
/// on h[i] d[i-1] + 2 (h[i-1] + h[i]) d[i] + h[i-1] d[i+1] = 3 (h[i] s[i-1] + h[i-1] s[i]).
std::vector<double> spline_slopes(const std::vector<double>& h, const std::vector<double>& s,
                                  double first, double last) {
  std::vector<double> factor(h.size() + 1, 0.0), slope(h.size() + 1, first);
  for (std::size_t i = 1; i < h.size(); ++i) {
    const double pivot = 2 * (h[i - 1] + h[i]) - h[i] * factor[i - 1];
    factor[i] = h[i - 1] / pivot;
    slope[i] = (3 * (h[i] * s[i - 1] + h[i - 1] * s[i]) - h[i] * slope[i - 1]) / pivot;
  }
  slope.back() = last;
  for (std::size_t i = h.size() - 1; i > 0; --i) slope[i] -= factor[i] * slope[i + 1];
  return slope;
}

}  // namespace

MeasuredProfile::MeasuredProfile(std::string name, RadialProfile samples, ProfileTail tail,
                                 std::optional<double> parameter)
    : name_(std::move(name)),
      samples_(checked_profile(std::move(samples))),
      tail_{.kind = tail},
      coordinate_(samples_) {
  if (tail != ProfileTail::none) fit_tail(parameter);
  if (samples_.r.size() > kMostProfileSamples) {
    auto [fewer, residual] = resampled(samples_);
    samples_ = std::move(fewer);
    resampling_ = residual;
    coordinate_ = ProfileCoordinate(samples_);
  }
  place_knots();
  join_knots();
  integrate();
}

void MeasuredProfile::fail(const std::string& why) const {
  throw std::domain_error("distribution " + support::quoted(name_) + ": " + why);
}

void MeasuredProfile::place_knots() {
  knots_.reserve(samples_.r.size());
  for (std::size_t i = 0; i < samples_.r.size(); ++i)
    knots_.push_back({samples_.r[i], coordinate_(samples_.r[i]), std::log(samples_.p22[i]), 0});
}

void MeasuredProfile::fit_tail(std::optional<double> parameter) {
  if (samples_.p22.back() == 0)
    fail("p22 is zero at the last sample, which leaves no tail to fit; declare the tail 'none'");
  const bool power = tail_.kind == ProfileTail::power;
  tail_.parameter = parameter.value_or(0);
  if (!parameter) {
    std::vector<double> x, y;
    const std::size_t n = samples_.r.size();
    for (std::size_t i = n - std::max(kFewestTailSamples, n / kTailShare); i < n; ++i) {
      if (samples_.p22[i] == 0 || (power && samples_.r[i] == 0)) continue;
      x.push_back(power ? std::log(samples_.r[i]) : samples_.r[i]);
      y.push_back(std::log(samples_.p22[i]));
    }
    if (x.size() < 2) fail("fewer than two of the last samples are positive: no tail to fit");
    const Line line = least_squares(x, y);
    tail_.parameter = -line.slope;
    tail_.residual = line.residual;
  }
  check_tail();
}

void MeasuredProfile::check_tail() const {
  const double rate = tail_.parameter;
  const std::string shown = support::rounded_text(rate);
  if (tail_.kind == ProfileTail::power && !(rate > kSmallestTailExponent))
    fail("the density falls as r^-" + shown +
         " at the last samples; the mean slope is finite only for exponents above 3");
  if (!(rate > 0))
    fail("the density does not fall at the last samples (exp(" + support::rounded_text(-rate) +
         " r)): no exponential tail fits");
  // Per factor e of the density, in last radii.
  const double steepness = tail_.kind == ProfileTail::power ? rate : rate * samples_.r.back();
  if (!(steepness >= kFlattestTail && steepness <= kSteepestTail))
    fail("the tail of parameter " + shown + " is too " +
         (steepness < kFlattestTail ? "flat: nearly all of the mass would lie beyond"
                                    : "steep: nothing would lie beyond") +
         " the last sample; declare another tail, or none");
}

double MeasuredProfile::log_slope_of_tail() const {
  const double r = knots_.back().r;
  const double per_radius =
      tail_.kind == ProfileTail::power ? tail_.parameter / r : tail_.parameter;
  return coordinate_.slope(-per_radius, r);
}

/// Sets the slopes of the knots of positive density.
void MeasuredProfile::join_knots() {
  const std::size_t first = samples_.p22.front() == 0 ? 1 : 0;
  const std::size_t end = knots_.size() - (samples_.p22.back() == 0 ? 1 : 0);
  if (end - first < 2) return;  // one knot between zeros, which straight lines join
  std::vector<double> h, s;
  for (std::size_t i = first; i + 1 < end; ++i) {
    h.push_back(knots_[i + 1].t - knots_[i].t);
    s.push_back((knots_[i + 1].value - knots_[i].value) / h.back());
  }
  const std::size_t n = h.size();
  double left = s[0], right = s[n - 1];
  if (n > 1) {
    left = parabola_end(h[0], h[1], s[0], s[1]);
    right = parabola_end(h[n - 1], h[n - 2], s[n - 1], s[n - 2]);
  }
  // The constant before the first sample and the tail beyond the last are joined without a kink.
  if (first == 0 && knots_[0].r > 0) left = 0;
  if (end == knots_.size() && tail_.kind != ProfileTail::none) right = log_slope_of_tail();
  const std::vector<double> slopes = spline_slopes(h, s, left, right);
  for (std::size_t i = 0; i <= n; ++i) {
    double slope = slopes[i];
    if (i > 0) slope = limited(slope, s[i - 1]);
    if (i < n) slope = limited(slope, s[i]);
    knots_[first + i].slope = slope;
  }
}

double MeasuredProfile::p22(double r) const {
  if (r > knots_.back().r) return beyond(r);
  const auto next = std::upper_bound(knots_.begin(), knots_.end() - 1, r,
                                     [](double radius, const Knot& k) { return radius < k.r; });
  return between(static_cast<std::size_t>(next - knots_.begin()), r);
}

/// p22 up to the knot `next`, from the one before or from 0.
double MeasuredProfile::between(std::size_t next, double r) const {
  if (next == 0) return samples_.p22.front();
  const Knot &a = knots_[next - 1], &b = knots_[next];
  if (std::isinf(a.value) || std::isinf(b.value))
    return std::lerp(std::exp(a.value), std::exp(b.value), (r - a.r) / (b.r - a.r));
  const double h = b.t - a.t, v = (coordinate_(r) - a.t) / h, w = 1 - v;
  return std::exp(w * w * ((1 + 2 * v) * a.value + v * h * a.slope) +
                  v * v * ((1 + 2 * w) * b.value - w * h * b.slope));
}

double MeasuredProfile::beyond(double r) const {
  const Knot& last = knots_.back();
  if (tail_.kind == ProfileTail::power)
    return std::exp(last.value - tail_.parameter * std::log(r / last.r));
  if (tail_.kind == ProfileTail::exponential)
    return std::exp(last.value - tail_.parameter * (r - last.r));
  return 0;
}

std::vector<double> MeasuredProfile::breaks() const {
  std::vector<double> radii;
  const auto add = [&](std::size_t i) {
    if (knots_[i].r > 0 && (radii.empty() || knots_[i].r > radii.back()))
      radii.push_back(knots_[i].r);
  };
  const std::size_t last = knots_.size() - 1;
  if (samples_.p22.front() == 0) add(0), add(1);
  if (samples_.p22.back() == 0) add(last - 1);
  add(last);
  return radii;
}

double MeasuredProfile::support() const {
  return tail_.kind == ProfileTail::none ? knots_.back().r : kInfinity;
}

void MeasuredProfile::integrate() {
  const Marginals all = *marginals(0);
  Marginals beyond_samples{0, 0, 0};
  if (tail_.kind != ProfileTail::none) add_tail(0, knots_.back().r, beyond_samples);
  mass_ = 2 * all.q;
  mean_slope_ = 2 * all.m / mass_;
  tail_.fraction_of_mass_beyond = beyond_samples.q / all.q;
  if (knots_.back().r > kFarthestSample * mean_slope_)
    fail("its last sample lies at r = " + support::rounded_text(knots_.back().r) +
         ", and the mean slope is " + support::rounded_text(mean_slope_) +
         "; end the profile where nothing of the mass is left, at " +
         support::rounded_text(kFarthestSample) + " mean slopes at most");
}

std::optional<Marginals> MeasuredProfile::marginals(double x) const {
  Marginals sum{0, 0, 0};
  const auto add = [&](double s, double mass) {
    sum.p += 2 * mass;
    sum.q += 2 * mass * s * std::atan2(s, x);
    sum.m += 2 * mass * s * s;
  };
  double low = 0;
  for (std::size_t i = 0; i < knots_.size(); ++i) {
    if (!(knots_[i].r > x)) continue;
    const double end = std::sqrt((knots_[i].r - x) * (knots_[i].r + x));
    while (low < end) {
      // atan(s / x) changes at s = x; for a tiny x that is no more than a kink at 0.
      const double high = x > kTiny * end ? std::min(end, std::max(x, 2 * low)) : end;
      for_each_node(low, high, [&](double s, double weight) {
        add(s, weight * between(i, std::sqrt(x * x + s * s)));
      });
      low = high;
    }
  }
  if (tail_.kind != ProfileTail::none) add_tail(x, low, sum);
  return sum;
}

/// Adds the integrals from s = `low` to infinity, s^2 = r^2 - x^2, with r beyond the last sample.
void MeasuredProfile::add_tail(double x, double low, Marginals& sum) const {
  thread_local boost::math::quadrature::exp_sinh<double> rule;
  const double r = std::max(x, knots_.back().r);
  const double scale = tail_.kind == ProfileTail::power ? r : std::sqrt(r / tail_.parameter);
  const auto integral = [&](auto weight) {
    return 2 * scale *
           rule.integrate(
               [&](double v) {
                 const double s = low + scale * v, density = beyond(std::hypot(x, s));
                 return density == 0 ? 0 : weight(s) * density;
               },
               0.0, kInfinity, kTolerance);
  };
  sum.p += integral([](double) { return 1.0; });
  sum.q += integral([x](double s) { return s * std::atan2(s, x); });
  sum.m += integral([](double s) { return s * s; });
}

}  // namespace vndf::distributions
