// From the slopes of a texture to a slope distribution.
#include "vndf/distributions/slope_map.h"

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <utility>
#include <vector>

namespace vndf::distributions {
namespace {

using Slopes = std::span<const Vec2<double>>;

[[noreturn]] void fail(const std::string& why) {
  throw std::domain_error("slope map: " + why);
}

void check(Slopes slopes) {
  if (slopes.size() < kFewestTexels)
    fail("it has " + std::to_string(slopes.size()) + " texels; at least " +
         std::to_string(kFewestTexels) + " are needed");
  for (std::size_t i = 0; i < slopes.size(); ++i)
    if (!std::isfinite(slopes[i].x) || !std::isfinite(slopes[i].y))
      fail("the slope of texel " + std::to_string(i) + " is not finite");
}

// Centre and stretch.

/// Centre and scatter matrix of an elliptical distribution, the latter in any unit.
struct Scatter {
  double x = 0, y = 0, xx = 0, xy = 0, yy = 0;

  double determinant() const { return xx * yy - xy * xy; }
};

/// One step of the iteration whose fixed point is the maximum of the Cauchy likelihood: means with
/// the weights 1 / (1 + d^2), d the distance from the centre in units of the scatter.
Scatter improved(Slopes slopes, const Scatter& s) {
  const double inverse = 1 / s.determinant();
  double sum = 0;
  Scatter moments;
  for (const Vec2<double>& slope : slopes) {
    const double dx = slope.x - s.x, dy = slope.y - s.y;
    const double square = (s.yy * dx * dx - 2 * s.xy * dx * dy + s.xx * dy * dy) * inverse;
    const double weight = 1 / (1 + square), wx = weight * dx, wy = weight * dy;
    sum += weight;
    moments.x += wx, moments.y += wy;
    moments.xx += wx * dx, moments.xy += wx * dy, moments.yy += wy * dy;
  }
  const double mx = moments.x / sum, my = moments.y / sum;
  return {s.x + mx, s.y + my, moments.xx / sum - mx * mx, moments.xy / sum - mx * my,
          moments.yy / sum - my * my};
}

/// Starts from the means, which are finite and of the right size for any slopes. The steps converge
/// linearly. Slopes on a line do not converge, because their scatter goes to 0 in one direction,
/// and are refused.
Scatter fit_scatter(Slopes slopes) {
  constexpr int kMostSteps = 300;
  constexpr double kConverged = 1e-10, kSmallest = 1e-12, kRounding = 1e-10;
  const auto n = static_cast<double>(slopes.size());
  Scatter s;
  double deviation = 0;
  for (const auto& slope : slopes) s.x += slope.x / n, s.y += slope.y / n;
  for (const auto& slope : slopes) deviation += std::hypot(slope.x - s.x, slope.y - s.y) / n;
  if (!(deviation > kRounding * std::hypot(s.x, s.y)))
    fail("all texels have the same slope: no roughness");
  s.xx = s.yy = deviation * deviation;
  for (int step = 0; step < kMostSteps; ++step) {
    const double size = s.xx + s.yy;
    if (!(size > kSmallest * deviation * deviation) || !(s.determinant() > kSmallest * size * size))
      break;
    const Scatter old = std::exchange(s, improved(slopes, s));
    const double change = std::hypot(s.xx - old.xx, s.yy - old.yy, s.xy - old.xy);
    if (change < kConverged * size) return s;
  }
  fail("the slopes do not spread in two directions: too many of them are equal or on one line");
}

/// Slopes without centre and stretch, still in any unit.
std::vector<Vec2<double>> whitened(Slopes slopes, const Scatter& s) {
  const double xx = std::sqrt(s.xx), yx = s.xy / xx, yy = std::sqrt(s.determinant()) / xx;
  std::vector<Vec2<double>> result;
  result.reserve(slopes.size());
  for (const auto& slope : slopes) {
    const double z = (slope.x - s.x) / xx;
    result.push_back({z, (slope.y - s.y - yx * z) / yy});
  }
  return result;
}

// Radial symmetry.

// Rings of equal numbers of slopes, and the harmonics of the azimuth within each: eight by eight
// see what a wrong centre (first harmonic), stretch (second) or weave (fourth) leaves.
constexpr std::size_t kRings = 8, kHarmonics = 8, kSectors = 256;

/// The azimuths of the slopes in one ring.
struct Ring {
  std::array<std::complex<double>, kHarmonics> harmonics{};
  std::array<double, kSectors> sectors{};
  double count = 0;

  void add(const Vec2<double>& slope, double r) {
    const std::complex<double> unit(slope.x / r, slope.y / r);
    std::complex<double> power = 1;
    for (auto& harmonic : harmonics) harmonic += power *= unit;
    const double turn = std::atan2(slope.y, slope.x) / (2 * std::numbers::pi) + 0.5;
    ++sectors[std::min(kSectors - 1, static_cast<std::size_t>(turn * kSectors))];
    ++count;
  }

  double departure() const {
    if (count == 0) return 0;
    double worst = 0, cdf = 0, low = 0, high = 0;
    for (const auto& harmonic : harmonics) worst = std::max(worst, std::abs(harmonic) / count);
    for (const double sector : sectors) {
      cdf += sector / count - 1.0 / kSectors;
      low = std::min(low, cdf), high = std::max(high, cdf);
    }
    return std::max(worst, high - low);
  }
};

void measure_asymmetry(Slopes slopes, const std::vector<double>& radii, bool ignore,
                       SlopeMapStatistics& result) {
  std::array<double, kRings - 1> edges;
  for (std::size_t k = 1; k < kRings; ++k) edges[k - 1] = radii[radii.size() * k / kRings];
  std::vector<Ring> rings(kRings);
  for (const auto& slope : slopes) {
    const double r = std::hypot(slope.x, slope.y);
    const auto ring = std::upper_bound(edges.begin(), edges.end(), r) - edges.begin();
    if (r > 0) rings[static_cast<std::size_t>(ring)].add(slope, r);
  }
  // The largest of 64 coefficients of n uniform azimuths is sqrt(log 64) = 2 in units of n^-1/2.
  constexpr double kExpectedLargest = 2, kSigmas = 4;
  const double sigma = 1 / std::sqrt(static_cast<double>(slopes.size()) / kRings);
  double worst = 0;
  for (const Ring& ring : rings) worst = std::max(worst, ring.departure());
  result.asymmetry = std::clamp(worst - kExpectedLargest * sigma, 0.0, 1.0);
  result.asymmetry_bound = kMaxAsymmetry + kSigmas * sigma;
  if (!ignore && result.asymmetry > result.asymmetry_bound)
    throw AsymmetricMap(
        "slope map: the slopes are not radially symmetric even after a stretch: asymmetry " +
        std::to_string(result.asymmetry) + " exceeds " + std::to_string(result.asymmetry_bound) +
        "; the option to ignore asymmetry averages them over azimuth all the same");
}

// The radial density.

/// Rings of about equal counts, then of halving ones: edges[k] to edges[k + 1] holds masses[k], and
/// the last mass lies beyond the last edge.
struct Histogram {
  std::vector<double> edges{0}, masses;
  std::size_t beyond = 0;  // how many radii lie beyond the last edge
};

/// n^(1/3) rings balance the noise of their masses with what a smooth curve does between them.
Histogram histogram_of(const std::vector<double>& radii) {
  const std::size_t n = radii.size(), fewest = std::max<std::size_t>(100, n / 1000);
  const auto share = static_cast<std::size_t>(std::cbrt(static_cast<double>(n)));
  const std::size_t equal = n / std::clamp<std::size_t>(share, 10, 200);
  // Maps of few bits have many radii that differ by rounding alone: they stay in one ring.
  const auto same = [&](std::size_t i) { return radii[i] <= radii[i - 1] * (1 + 1e-9); };
  Histogram h;
  std::size_t begin = 0;
  while ((n - begin) / 2 >= fewest) {
    std::size_t end = begin + std::min(equal, (n - begin) / 2);
    while (end < n && same(end)) ++end;
    if (n - end < fewest) break;
    h.edges.push_back((radii[end - 1] + radii[end]) / 2);
    h.masses.push_back(static_cast<double>(end - begin) / static_cast<double>(n));
    begin = end;
  }
  h.beyond = n - begin;
  h.masses.push_back(static_cast<double>(h.beyond) / static_cast<double>(n));
  if (h.masses.size() < 5) fail("its slopes take too few different values");
  return h;
}

/// A density of the radii beyond an edge; `area` times p22 at the edge is its mass.
struct TailModel {
  ProfileTail kind;
  double parameter, area, log_likelihood;
};

/// The three models with their likeliest parameters.
std::array<TailModel, 3> tail_models(std::span<const double> largest, double edge) {
  constexpr double kTurn = 2 * std::numbers::pi;
  const auto n = static_cast<double>(largest.size());
  double mean = 0, log = 0;
  for (const double r : largest) mean += r / n, log += std::log(r) / n;
  // r^-(k+1), Hill's estimator of k; p22 falls two powers faster than the tail of the CDF.
  const double k = 1 / (log - std::log(edge));
  const double power = std::log(k / edge) - (k + 1) * (log - std::log(edge));
  // r exp(-b r): setting the derivative by b to zero leaves a quadratic equation.
  const double excess = mean - edge, gap = edge - excess;
  const double b = (gap + std::sqrt(gap * gap + 8 * excess * edge)) / (2 * excess * edge);
  const double area = (edge + 1 / b) / b;
  const double exponential = log - b * excess - std::log(area);
  // r up to an edge: p22 constant.
  const double last = largest.back(), ring = (last - edge) * (last + edge);
  return {{{ProfileTail::power, k + 2, kTurn * edge * edge / k, power},
           {ProfileTail::exponential, b, kTurn * area, exponential},
           {ProfileTail::none, 0, kTurn * ring / 2, log + std::log(2 / ring)}}};
}

/// The kind that is likeliest for the largest hundredth; the parameter for what lies beyond `edge`.
TailModel choose_tail(const std::vector<double>& radii, const Histogram& h) {
  const std::size_t n = radii.size(), top = std::max<std::size_t>(100, n / 100);
  const std::span<const double> all(radii);
  const double edge = all[n - top - 1];
  const auto tails = tail_models(all.last(h.beyond), h.edges.back());
  if (edge == radii.back()) return tails.back();  // a clipped map
  const auto models = tail_models(all.last(top), edge);
  const auto best = std::ranges::max_element(models, {}, &TailModel::log_likelihood);
  return tails[static_cast<std::size_t>(best - models.begin())];
}

double ring_mass(const MeasuredProfile& profile, double low, double high) {
  return boost::math::quadrature::gauss<double, 10>::integrate(
      [&](double r) { return 2 * std::numbers::pi * r * profile.p22(r); }, low, high);
}

/// The density is sought in the middle of each ring by area, and where the tail starts.
RadialProfile first_profile(const Histogram& h) {
  RadialProfile profile;
  for (std::size_t k = 0; k + 1 < h.edges.size(); ++k) {
    const double low = h.edges[k] * h.edges[k], high = h.edges[k + 1] * h.edges[k + 1];
    profile.r.push_back(std::sqrt((low + high) / 2));
    profile.p22.push_back(h.masses[k] / (std::numbers::pi * (high - low)));
  }
  profile.r.push_back(h.edges.back());
  profile.p22.push_back(profile.p22.back());
  return profile;
}

/// A smooth density that has the mass of the histogram in every ring and hence the empirical CDF at
/// every edge. Its samples are multiplied by the missing factors until these are 1 to 1e-9, far
/// below the statistical error of any map.
MeasuredProfile fit_profile(const std::string& name, const Histogram& h, const TailModel& tail) {
  constexpr int kMostSteps = 60;
  constexpr double kConverged = 1e-9;
  RadialProfile profile = first_profile(h);
  if (tail.kind != ProfileTail::none) profile.p22.back() = h.masses.back() / tail.area;
  for (int step = 0;; ++step) {
    MeasuredProfile estimate(name, profile, tail.kind, tail.parameter);
    double worst = 0;
    for (std::size_t k = 0; k + 1 < h.edges.size(); ++k) {
      const double mass = ring_mass(estimate, h.edges[k], profile.r[k]) +
                          ring_mass(estimate, profile.r[k], h.edges[k + 1]);
      profile.p22[k] *= h.masses[k] / mass;
      worst = std::max(worst, std::abs(mass - h.masses[k]));
    }
    if (tail.kind == ProfileTail::none) profile.p22.back() = profile.p22.end()[-2];
    if (worst < kConverged || step == kMostSteps) return estimate;
  }
}

std::unique_ptr<MeasuredProfile> in_mean_slopes(const MeasuredProfile& estimate) {
  const double unit = estimate.mean_slope();
  RadialProfile profile = estimate.samples();
  for (double& r : profile.r) r /= unit;
  for (double& density : profile.p22) density *= unit * unit / estimate.mass();
  const auto& [kind, parameter, beyond, residual] = estimate.tail();
  return std::make_unique<MeasuredProfile>(
      estimate.name(), std::move(profile), kind,
      kind == ProfileTail::exponential ? parameter * unit : parameter);
}

}  // namespace

SlopeMapEstimate estimate_slope_map(Slopes slopes, const SlopeMapOptions& options) {
  check(slopes);
  const Scatter s = fit_scatter(slopes);
  const auto white = whitened(slopes, s);
  std::vector<double> radii;
  radii.reserve(white.size());
  for (const auto& slope : white) radii.push_back(std::hypot(slope.x, slope.y));
  std::sort(radii.begin(), radii.end());

  SlopeMapStatistics statistics{.texels = slopes.size()};
  measure_asymmetry(white, radii, options.ignore_asymmetry, statistics);
  Histogram h = histogram_of(radii);
  const TailModel tail = choose_tail(radii, h);
  if (tail.kind == ProfileTail::none) h.edges.push_back(radii.back());
  const MeasuredProfile estimate = fit_profile(options.name, h, tail);
  const double unit = estimate.mean_slope();
  statistics.surface = {
      {unit * std::sqrt(s.xx), unit * std::sqrt(s.yy)}, s.xy / std::sqrt(s.xx * s.yy), {s.x, s.y}};
  const double sum = std::accumulate(radii.begin(), radii.end(), 0.0);
  const double squares = std::inner_product(radii.begin(), radii.end(), radii.begin(), 0.0);
  statistics.u_error = std::sqrt(std::log(2 / 0.05) / 2 * squares) / sum;
  return {in_mean_slopes(estimate), statistics};
}

}  // namespace vndf::distributions
