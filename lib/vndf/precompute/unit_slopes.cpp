// Integrates a slope distribution and samples the curves of Q and M.
#include "vndf/precompute/unit_slopes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "vndf/precompute/interpolated_density.h"
#include "vndf/precompute/make_curve.h"
#include "vndf/support/text.h"

namespace vndf::precompute {
namespace {

// Nodes of each segment of a curve, which give kCurveError (unit_slopes.h).
constexpr std::size_t kNodes = 8192;
// A power tail is straight in log Q over asinh(x) to x^-2, below rounding at sinh(20) = 2.4e8. A
// light tail is followed until it is smaller than any probability that can matter.
constexpr double kFarthestAsinh = 20;
constexpr double kSmallestTail = 1e-250;
// The errors that the quadratures estimate are looked at in places where Q is above the smallest
// probability in a table. Beyond them an integral has no digits to lose.
constexpr double kSmallestProbability = 1e-12;
constexpr std::size_t kErrorPlaces = 256;
// A tail with a larger exponent counts as light: (1e-9)^(1/100) is 0.8, so that it ends within the
// same octave for all probabilities that matter.
constexpr double kLargestExponent = 100;

// Equidistant nodes are tried first and probed at these many places. Where Q is above
// exp(-35) = 6e-16 they may show this error in log Q, or else the nodes are graded towards the
// centre.
constexpr int kProbes = 48;
constexpr double kNegligibleLog = -35;
constexpr double kResolved = 1e-12;

/// Whether cubics between nodes `h` apart follow `f` over (0, end). Their error is a 384th of the
/// fourth difference. The probes crowd at the beginning, because the narrowest part of a density
/// lies at its centre.
bool resolved(const std::function<double(double)>& f, double end, double h) {
  for (int k = 0; k < kProbes; ++k) {
    const double a = end * std::pow((k + 0.5) / kProbes, 4);
    if (a - 2 * h < 0 || a + 2 * h > end || f(a) < kNegligibleLog) continue;
    const double fourth = f(a - 2 * h) - 4 * f(a - h) + 6 * f(a) - 4 * f(a + h) + f(a + 2 * h);
    if (std::abs(fourth) / 384 > kResolved) return false;
  }
  return true;
}

double relative_error(const distributions::Estimate& e) {
  return e.value > 0 ? e.error / e.value : 0;
}

/// Throws where slopes that matter are beyond the range of double precision.
void require_range(const UnitSlopes& slopes) {
  constexpr double kFarthest = 700;  // asinh of 5e303
  constexpr double kLargestShare = 1e-9;
  const double share = 2 * slopes.m(kFarthest);
  if (share <= kLargestShare) return;
  throw std::domain_error("distribution " + support::quoted(slopes.distribution().name()) +
                          ": at grazing incidence a share of " + support::rounded_text(share) +
                          " of the visible slopes is above 5e303, the end of double precision; the "
                          "tail of p22 must fall faster than r^-3.03");
}

}  // namespace

UnitSlopes::UnitSlopes(const distributions::SlopeDistribution& d, const support::Workers& workers)
    : distribution_(&d),
      mass_(distributions::slope_mass(d).value),
      mean_slope_(vndf::distributions::mean_slope(d, mass_).value) {
  if (d.costly()) {
    interpolated_ = interpolated_density(d, mean_slope_, workers);
    distribution_ = interpolated_.get();
  }
  const auto at = [&](double a) { return marginals(*distribution_, mean_slope_ * std::sinh(a)); };
  double end = kFarthestAsinh;
  const double smallest = kSmallestTail * mass_;
  const bool open = std::isinf(d.support());
  while (open && upper_tail(std::sinh(end)).value * mass_ <= smallest && end > 1e-3) end *= 0.98;

  const auto log_q = [&](double a) { return std::log(upper_tail(std::sinh(a)).value); };
  const auto ends = segment_ends(d, mean_slope_, end);
  const bool narrow = open && ends.size() == 2 && !resolved(log_q, end, end / (kNodes - 1));
  const CurveOptions options{.nodes = kNodes, .open = open, .cusp = narrow};
  log_q_ = make_curve(log_q, ends, options, workers);
  log_m_ = make_curve([&](double a) { return std::log(moment(std::sinh(a)).value); }, ends, options,
                      workers);

  require_range(*this);

  for (std::size_t k = 0; k < kErrorPlaces; ++k) {
    const auto e = at(ends.back() * static_cast<double>(k) / kErrorPlaces);
    if (e.q.value > kSmallestProbability * mass_)
      quadrature_error_ = std::max(
          {quadrature_error_, relative_error(e.p), relative_error(e.q), relative_error(e.m)});
  }
}

double UnitSlopes::tail_exponent() const {
  if (std::isfinite(support())) return std::numeric_limits<double>::infinity();
  const double exponent = -log_m_.log_slope_at(log_m_.segments().back().end * 2);
  return exponent < kLargestExponent ? exponent : std::numeric_limits<double>::infinity();
}

distributions::Estimate UnitSlopes::density(double x) const {
  const double at = x * mean_slope_;
  const auto known = distribution_->marginals(at);
  const distributions::Estimate p =
      known ? distributions::Estimate{known->p, 0} : marginal_density(*distribution_, at);
  const double scale = mean_slope_ / mass_;
  return {p.value * scale, p.error * scale};
}

distributions::Estimate UnitSlopes::upper_tail(double x) const {
  const double at = x * mean_slope_;
  const auto known = distribution_->marginals(at);
  const distributions::Estimate q = known ? distributions::Estimate{known->q, 0}
                                          : vndf::distributions::upper_tail(*distribution_, at);
  return {q.value / mass_, q.error / mass_};
}

distributions::Estimate UnitSlopes::moment(double x) const {
  const double at = x * mean_slope_;
  const auto known = distribution_->marginals(at);
  const distributions::Estimate m =
      known ? distributions::Estimate{known->m, 0} : partial_moment(*distribution_, at);
  const double scale = 1 / (mass_ * mean_slope_);
  return {m.value * scale, m.error * scale};
}

distributions::Estimate UnitSlopes::backfacing(double c) const {
  const double scale = 1 / (mass_ * mean_slope_);
  const double at = c * mean_slope_;
  // B = M - c Q where both are known and the difference keeps most of its digits, as it does in a
  // power tail: at most three are lost.
  constexpr double kKept = 1e-3;
  if (const auto known = distribution_->marginals(at)) {
    const double difference = known->m - at * known->q;
    if (difference > kKept * known->m) return {difference * scale, 0};
  }
  const distributions::Estimate b = distributions::backfacing(*distribution_, at);
  return {b.value * scale, b.error * scale};
}

}  // namespace vndf::precompute
