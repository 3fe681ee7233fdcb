// The convergence experiment of Heitz and d'Eon 2014 (Figure 10).
#include "vndf/validate/experiment/variance_experiment.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "vndf/support/parallel.h"

namespace vndf::validate {
namespace {

bool positive(double x) {
  return x > 0 && std::isfinite(x);
}

/// Blocks are run in groups, so that what is kept does not grow with the number of samples.
constexpr std::uint64_t kGroups = 256;

std::vector<Tally> run_all(const std::vector<Estimator>& estimators,
                           const VarianceOptions& options) {
  const std::uint64_t blocks = (options.samples - 1) / kBlockSamples + 1;
  const std::uint64_t groups = std::min(blocks, kGroups);
  std::vector<Tally> tallies(estimators.size() * groups);
  support::parallel_for(tallies.size(), options.workers, [&](std::size_t piece) {
    const std::uint64_t estimator = piece / groups, group = piece % groups;
    for (std::uint64_t b = group * blocks / groups; b < (group + 1) * blocks / groups; ++b)
      tallies[piece].merge(
          estimators[estimator].run_block(options, BlockRandom(options.seed, estimator, b)));
  });

  std::vector<Tally> sums(estimators.size());
  for (std::size_t piece = 0; piece < tallies.size(); ++piece)
    sums[piece / groups].merge(tallies[piece]);
  return sums;
}

/// Variance of the first of `results` that `is_baseline` accepts over that of `result`.
template <class IsBaseline>
double gain_over(const std::vector<EstimatorResult>& results, const EstimatorResult& result,
                 IsBaseline is_baseline) {
  for (const auto& r : results)
    if (r.surface == result.surface && is_baseline(r))
      return r.samples().variance() / result.samples().variance();
  return 0;
}

/// Distance from the mean of the others, each weighted by its certainty, in standard errors.
double deviation_of(const std::vector<EstimatorResult>& results, const EstimatorResult& result) {
  double weights = 0, sum = 0;
  for (const auto& r : results) {
    const double error = r.samples().standard_error();
    if (&r == &result || r.surface != result.surface || !(error > 0)) continue;
    weights += 1 / (error * error);
    sum += r.samples().mean / (error * error);
  }
  if (weights == 0) return 0;
  return (result.samples().mean - sum / weights) /
         std::hypot(result.samples().standard_error(), 1 / std::sqrt(weights));
}

}  // namespace

void Tally::add(double weight, const Vec3<double>& wo, const Environment& light) {
  largest_weight = std::max(largest_weight, weight);
  if (weight == 0) ++lost;
  pyramid.add(weight > 0 ? weight * light.radiance(wo) : 0);
}

void Tally::merge(const Tally& other) {
  pyramid.merge(other.pyramid);
  largest_weight = std::max(largest_weight, other.largest_weight);
  lost += other.lost;
}

Vec3<double> incident_direction(const VarianceOptions& options) {
  const double theta = options.theta * kDegree, phi = options.azimuth * kDegree;
  // The sine of the elevation, so that 90 degrees is the horizon itself.
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
          std::sin((90 - options.theta) * kDegree)};
}

void require_valid(const VarianceOptions& options) {
  if (!(options.theta >= 0 && options.theta <= 90))
    throw std::invalid_argument("variance experiment: theta must be in [0, 90] degrees");
  if (!std::isfinite(options.azimuth))
    throw std::invalid_argument("variance experiment: the azimuth must be finite");
  if (!positive(options.alpha.x) || !positive(options.alpha.y))
    throw std::invalid_argument("variance experiment: alpha must be > 0 and finite");
  if (!positive(options.metal.eta) || !(options.metal.k >= 0 && std::isfinite(options.metal.k)))
    throw std::invalid_argument("variance experiment: the metal needs eta > 0 and k >= 0");
  if (options.samples == 0)
    throw std::invalid_argument("variance experiment: the number of samples must be > 0");
}

std::vector<EstimatorResult> run_variance_experiment(const std::vector<Estimator>& estimators,
                                                     const VarianceOptions& options) {
  require_valid(options);
  const std::vector<Tally> tallies = run_all(estimators, options);
  std::vector<EstimatorResult> results;
  for (std::size_t i = 0; i < estimators.size(); ++i)
    results.push_back(
        {estimators[i].name, estimators[i].surface, estimators[i].visible, tallies[i], 0, 0, 0});
  for (auto& r : results) {
    r.gain = gain_over(results, r, [](const auto&) { return true; });
    r.gain_over_visible = gain_over(results, r, [](const auto& b) { return b.visible; });
    r.deviation = deviation_of(results, r);
  }
  return results;
}

}  // namespace vndf::validate
