// The distribution of sampled slopes as a picture.
#include "vndf/validate/pictures/slope_histogram.h"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <mutex>
#include <numbers>

#include "vndf/validate/exact/exact_distribution.h"
#include "vndf/validate/statistics/block_random.h"

namespace vndf::validate {
namespace {

constexpr unsigned kPoints = 7;  // of Gauss's rule, on each side of a cell
constexpr double kShown = 0.85;  // of the mass of all slopes
constexpr double kMargin = 1.05;
constexpr std::uint64_t kBlock = 1 << 15;

struct Square {
  double x, y, side;  // the lower left corner
};

/// Integrals of the exact density of slopes over squares. A square in which the density jumps, has
/// a kink or a pole is divided into four, and these again, kDivisions times.
class SlopeMass {
 public:
  SlopeMass(const SamplerUnderTest& sampler, const Configuration& c)
      : distribution_(*sampler.exact, sampler.claims.normals, c, Use::few),
        c_(c),
        kind_(sampler.claims.normals),
        breaks_(sampler.exact->unit_slopes().distribution().breaks()) {}

  double of(const Square& square, int divisions = kDivisions) const {
    if (divisions == 0 || is_smooth(square)) return integral(square);
    const double half = square.side / 2;
    double sum = 0;
    for (const double dx : {0.0, half})
      for (const double dy : {0.0, half})
        sum += of({square.x + dx, square.y + dy, half}, divisions - 1);
    return sum;
  }

 private:
  static constexpr int kDivisions = 6;

  double density(double x, double y) const {
    const double length = std::hypot(x, y, 1);
    const Vec3<double> wm{-x / length, -y / length, 1 / length};
    return distribution_.pdf(wm) * wm.z * wm.z * wm.z;
  }
  double integral(const Square& s) const {
    using Gauss = boost::math::quadrature::gauss<double, kPoints>;
    return Gauss::integrate(
        [&](double y) {
          return Gauss::integrate([&](double x) { return density(x, y); }, s.x, s.x + s.side);
        },
        s.y, s.y + s.side);
  }

  bool is_smooth(const Square& s) const {
    const auto nearest = [&](double low) { return std::clamp(0.0, low, low + s.side); };
    const auto farthest = [&](double low) { return std::max(std::abs(low), low + s.side); };
    const double ax = c_.alpha.x, ay = c_.alpha.y;
    const double from = std::hypot(nearest(s.x) / ax, nearest(s.y) / ay);
    const double to = std::hypot(farthest(s.x) / ax, farthest(s.y) / ay);
    if (to > 2 * from) return false;  // near the pole p22 may be of any scale
    for (const double r : breaks_)
      if (from < r && r < to) return false;
    return kind_ == SampledNormals::all || !on_the_edge(s);
  }
  /// Whether the edge of visibility passes through the square.
  bool on_the_edge(const Square& s) const {
    const auto cosine = [&](double x, double y) { return c_.wi.z - c_.wi.x * x - c_.wi.y * y; };
    const double x2 = s.x + s.side, y2 = s.y + s.side;
    const auto [low, high] =
        std::minmax({cosine(s.x, s.y), cosine(x2, s.y), cosine(s.x, y2), cosine(x2, y2)});
    return low < 0 && high > 0;
  }

  ExactDistribution distribution_;
  Configuration c_;
  SampledNormals kind_;
  std::vector<double> breaks_;
};

/// Numbers of samples in each cell.
class Counts {
 public:
  Counts(std::size_t cells, double half_width)
      : cells_(cells), half_width_(half_width), counts_(cells * cells) {}

  void add(const Vec2<double>& slope) {
    const double scale = static_cast<double>(cells_) / (2 * half_width_);
    const double column = (slope.x + half_width_) * scale, row = (slope.y + half_width_) * scale;
    const auto inside = [this](double v) { return v >= 0 && v < static_cast<double>(cells_); };
    if (inside(column) && inside(row))
      ++counts_[static_cast<std::size_t>(row) * cells_ + static_cast<std::size_t>(column)];
  }
  void add(const Counts& other) {
    for (std::size_t k = 0; k < counts_.size(); ++k) counts_[k] += other.counts_[k];
  }
  std::uint64_t operator[](std::size_t k) const { return counts_[k]; }

 private:
  std::size_t cells_;
  double half_width_;
  std::vector<std::uint64_t> counts_;
};

void count_block(const SamplerUnderTest& sampler, const Configuration& c, BlockRandom random,
                 std::uint64_t samples, Counts& counts) {
  std::vector<RandomPair> u(samples);
  std::vector<Vec3<double>> wm(samples);
  for (RandomPair& pair : u) {
    pair.x = random.single();
    pair.y = random.single();
  }
  sampler.sample(c, u, wm);
  for (const Vec3<double>& m : wm) counts.add(slope_of(m));
}

Counts count(const SamplerUnderTest& sampler, const Configuration& c, double half_width,
             const HistogramOptions& options) {
  Counts all(options.cells, half_width);
  std::mutex mutex;  // guards `all`
  const std::uint64_t blocks = (options.samples + kBlock - 1) / kBlock;
  support::parallel_for(blocks, options.workers, [&](std::size_t block) {
    Counts counts(options.cells, half_width);
    count_block(sampler, c, BlockRandom(options.seed, options.stream, block),
                std::min(kBlock, options.samples - block * kBlock), counts);
    const std::lock_guard lock(mutex);
    all.add(counts);
  });
  return all;
}

}  // namespace

double shown_slopes(const ExactSlopes& exact, const Alpha<double>& alpha) {
  const auto& slopes = exact.unit_slopes();
  double r = slopes.support();
  if (std::isinf(r)) {
    double low = 0, high = std::asinh(1e6);  // units of the mean slope
    for (int k = 0; k < 60; ++k) {
      const double middle = (low + high) / 2;
      (exact.all_radii().cdf(middle).u < kShown ? low : high) = middle;
    }
    r = std::sinh(high);
  }
  return kMargin * r * slopes.mean_slope() * std::max(alpha.x, alpha.y);
}

Grid exact_slope_density(const SamplerUnderTest& sampler, const Configuration& c, double half_width,
                         std::size_t cells) {
  const SlopeMass mass(sampler, c);
  const double side = 2 * half_width / static_cast<double>(cells);
  Grid exact(cells, cells);
  for (std::size_t j = 0; j < cells; ++j)
    for (std::size_t i = 0; i < cells; ++i) {
      const double x = static_cast<double>(i) * side, y = static_cast<double>(j) * side;
      exact.at(i, j) = mass.of({x - half_width, y - half_width, side}) / (side * side);
    }
  return exact;
}

double poisson_deviate(std::uint64_t count, double expected) {
  if (!(expected > 0)) return count == 0 ? 0 : kLargestDeviation;
  const double k = static_cast<double>(count);
  // P(N < k) and P(N > k) of Poisson's distribution; what is left is P(N = k).
  const double less = count == 0 ? 0 : boost::math::gamma_q(k, expected);
  const double more = boost::math::gamma_p(k + 1, expected);
  const double lower = less + (1 - less - more) / 2, upper = more + (1 - less - more) / 2;
  const double tail = std::min(lower, upper);
  if (!(tail > 0)) return lower < upper ? -kLargestDeviation : kLargestDeviation;
  const double deviate = std::numbers::sqrt2 * boost::math::erfc_inv(2 * std::min(tail, 0.5));
  return std::min(deviate, kLargestDeviation) * (lower < upper ? -1 : 1);
}

SlopeHistogram slope_histogram(const SamplerUnderTest& sampler, const Configuration& c,
                               double half_width, const HistogramOptions& options) {
  SlopeHistogram h{.configuration = c, .half_width = half_width, .samples = options.samples};
  h.exact = exact_slope_density(sampler, c, half_width, options.cells);
  h.sampled = h.deviation = Grid(options.cells, options.cells);
  const Counts counts = count(sampler, c, half_width, options);
  const double side = 2 * half_width / static_cast<double>(options.cells), area = side * side;
  const double samples = static_cast<double>(options.samples);
  double squares = 0;
  for (std::size_t k = 0; k < h.exact.values.size(); ++k) {
    const double mass = h.exact.values[k] * area, expected = mass * samples;
    h.inside += mass;
    h.sampled.values[k] = static_cast<double>(counts[k]) / (samples * area);
    const double deviation = h.deviation.values[k] = poisson_deviate(counts[k], expected);
    if (expected < kFewestInCell) continue;
    squares += deviation * deviation;
    ++h.compared;
  }
  if (h.compared > 0) h.mean_square = squares / static_cast<double>(h.compared);
  return h;
}

}  // namespace vndf::validate
