// The convergence experiment of Heitz and d'Eon 2014 (Figure 10): one pixel of a rough metal, seen
// from a fixed direction under a given light, is estimated with N samples over and over. All
// estimators of one surface have the same mean; what tells them apart is how far a pixel of N
// samples strays from it.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "vndf/bsdf/conductor_brdf.h"
#include "vndf/bsdf/normal_sampler.h"
#include "vndf/support/parallel.h"
#include "vndf/validate/experiment/environment.h"
#include "vndf/validate/statistics/block_random.h"
#include "vndf/validate/statistics/moments.h"

namespace vndf::validate {

/// What is seen, and with how many samples.
struct VarianceOptions {
  /// The incident direction: its angle from the normal, in [0, 90], and around it, in degrees.
  double theta = 80, azimuth = 0;
  Alpha<double> alpha{0.5, 0.5};
  ComplexIndex<double> metal{0.2, 3.0};
  Environment light = smooth_environment();
  /// Samples of each estimator, rounded up to whole blocks of kBlockSamples.
  std::uint64_t samples = 1 << 20;
  /// Results depend on it, and not on the number of threads.
  std::uint64_t seed = 1;
  support::Workers workers = {};
};

/// Pixels of 4^k samples for k from 0 to kLevels - 1, all from the same stream of samples.
class PixelPyramid {
 public:
  static constexpr std::size_t kChildren = 4, kLevels = 9;

  /// Adds one sample of radiance.
  void add(double value) {
    for (Level& level : levels_) {
      level.pixels.add(value);
      level.sum += value;
      if (++level.children < kChildren) return;
      value = level.sum / kChildren;
      level.sum = 0;
      level.children = 0;
    }
  }

  /// Joins another pyramid. Both hold whole pixels of the highest level.
  void merge(const PixelPyramid& other) {
    for (std::size_t k = 0; k < kLevels; ++k) levels_[k].pixels.merge(other.levels_[k].pixels);
  }

  /// The moments of pixels of 4^level samples.
  const Moments& pixels(std::size_t level) const { return levels_[level].pixels; }

 private:
  struct Level {
    Moments pixels;
    double sum = 0;
    std::size_t children = 0;
  };
  std::array<Level, kLevels> levels_;
};

/// Samples of one block, which is one pixel of the highest level.
inline constexpr std::uint64_t kBlockSamples = 1 << (2 * (PixelPyramid::kLevels - 1));

/// What was seen of one estimator.
struct Tally {
  PixelPyramid pyramid;
  double largest_weight = 0;
  std::uint64_t lost = 0;  ///< samples of weight 0

  /// Adds one sample: its weight, and the direction from which light comes.
  void add(double weight, const Vec3<double>& wo, const Environment& light);
  void merge(const Tally& other);
};

/// One way to estimate the pixel.
struct Estimator {
  std::string name;
  std::string surface;  ///< estimators of one surface are of one BRDF, and have one mean
  bool visible;         ///< draws visible normals, so that no weight is above 1
  /// Draws kBlockSamples samples.
  std::function<Tally(const VarianceOptions&, BlockRandom)> run_block;
};

/// The incident direction of `options`.
Vec3<double> incident_direction(const VarianceOptions& options);

/// The estimator that samples the BRDF of `sampler` and `Masking` as ConductorBrdf does.
template <class Masking, class Sampler>
requires NormalSampler<Sampler, double> Estimator make_estimator(std::string name,
                                                                 std::string surface,
                                                                 Sampler sampler) {
  const auto run_block = [sampler = std::move(sampler)](const VarianceOptions& options,
                                                        BlockRandom random) {
    const ConductorFresnel<double, 1> metal{{options.metal.eta}, {options.metal.k}};
    const ConductorBrdf brdf(sampler, options.alpha, metal, Masking{});
    const Vec3<double> wi = incident_direction(options);
    Tally tally;
    for (std::uint64_t i = 0; i < kBlockSamples; ++i) {
      const double u1 = random.uniform(), u2 = random.uniform();
      const auto drawn = brdf.sample(wi, u1, u2);
      tally.add(drawn.weight[0], drawn.wo, options.light);
    }
    return tally;
  };
  return {std::move(name), std::move(surface), Sampler::kVisible, run_block};
}

/// What the experiment measured of one estimator.
struct EstimatorResult {
  std::string name, surface;
  bool visible;
  Tally tally;
  /// Variance of the surface's first estimator over that of this one. Above 1, this one is better.
  double gain;
  /// The same against the surface's first estimator by visible normals; 0 where there is none.
  double gain_over_visible;
  /// Its mean less that of the other estimators of the surface together, in standard errors; 0 if
  /// it is alone.
  double deviation;

  const Moments& samples() const { return tally.pyramid.pixels(0); }
  double lost_fraction() const {
    return static_cast<double>(tally.lost) / static_cast<double>(samples().count);
  }
};

/// Throws std::invalid_argument, naming the input and the rule, for theta outside [0, 90], alpha or
/// metal that are not positive and finite, or no samples.
void require_valid(const VarianceOptions& options);

/// Runs every estimator. Throws as require_valid() does.
std::vector<EstimatorResult> run_variance_experiment(const std::vector<Estimator>& estimators,
                                                     const VarianceOptions& options);

}  // namespace vndf::validate
