// The variance experiment measures what is known, and notices an estimator that is wrong.
#include "vndf/validate/experiment/variance_experiment.h"

#include <cmath>
#include <random>
#include <vector>

#include "support/bsdf_inputs.h"
#include "support/built_tables.h"
#include "support/catch.h"
#include "vndf/bsdf/all_normals.h"
#include "vndf/tabulated_sampler.h"
#include "vndf/validate/experiment/named_estimators.h"

using namespace vndf;
using namespace vndf::test;
using namespace vndf::validate;

namespace {

using Ggx = ExactGgx<double>;
using AllGgx = AllNormals<Ggx>;

/// Largest distance of two right means in standard errors: 1 in 1e5 comparisons is beyond, and the
/// seeds are fixed.
constexpr double kSameMean = 4.5;

/// Every way to sample GGX, of both surfaces.
std::vector<Estimator> ggx_estimators() {
  return named_estimators(small_tables("ggx").tables);
}

VarianceOptions options_at(double theta, const Alpha<double>& alpha, const Environment& light,
                           std::uint64_t samples = 1 << 18) {
  VarianceOptions options;
  options.theta = theta;
  options.alpha = alpha;
  options.light = light;
  options.samples = samples;
  return options;
}

const EstimatorResult& find(const std::vector<EstimatorResult>& results, const std::string& name,
                            const std::string& surface = "smith") {
  for (const auto& r : results)
    if (r.name == name && r.surface == surface) return r;
  FAIL("no estimator " << name);
  return results.front();
}

/// The pixel by quadrature over wo.
template <class Masking>
double exact_radiance(const VarianceOptions& options) {
  const ConductorFresnel<double, 1> metal{{options.metal.eta}, {options.metal.k}};
  const Ggx ggx;
  const ConductorBrdf brdf(ggx, options.alpha, metal, Masking{});
  const auto wi = incident_direction(options);
  return over_hemisphere(
      [&](const auto& wo) { return brdf.evaluate(wi, wo)[0] * options.light.radiance(wo); });
}

/// Draws the normals of another roughness than it says.
template <class Sampler>
class WrongRoughness : public Sampler {
 public:
  Vec3<double> sample(const Vec3<double>& wi, const Alpha<double>& alpha, double u1,
                      double u2) const noexcept {
    return Sampler::sample(wi, {1.1 * alpha.x, 1.1 * alpha.y}, u1, u2);
  }
};

/// Lambda is 10 % too large, as by a bad fit.
class WrongLambda : public Ggx {
 public:
  double g1(const Vec3<double>& w, const Alpha<double>& alpha) const noexcept {
    return 1 / (1 + 1.1 * lambda(w, alpha));
  }
};

}  // namespace

TEST_CASE("moments are the mean and the variance, however the stream is cut") {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal(1e6, 1);  // sums of squares would lose all but 3 digits
  std::vector<double> values(10000);
  for (double& v : values) v = normal(random);

  long double sum = 0, squares = 0;
  for (const double v : values) sum += v;
  const long double mean = sum / static_cast<long double>(values.size());
  for (const double v : values) squares += (v - mean) * (v - mean);
  const double variance =
      static_cast<double>(squares / static_cast<long double>(values.size() - 1));

  for (const std::size_t cut : {0u, 1u, 3333u, 10000u}) {
    Moments left, right;
    for (std::size_t i = 0; i < values.size(); ++i) (i < cut ? left : right).add(values[i]);
    left.merge(right);
    CAPTURE(cut);
    CHECK(left.count == values.size());
    CHECK(left.mean == Approx(static_cast<double>(mean)).epsilon(1e-14));
    CHECK(left.variance() == Approx(variance).epsilon(1e-9));
    CHECK(left.standard_error() == Approx(std::sqrt(variance / 10000)).epsilon(1e-9));
  }
  CHECK(Moments{}.variance() == 0);
  CHECK(Moments{}.standard_error() == 0);
}

TEST_CASE("a pixel of the pyramid is the mean of four of the level below") {
  PixelPyramid pyramid;
  Moments of_four;
  for (int i = 0; i < 64; ++i) {
    pyramid.add(i * i);
    if (i % 4 == 3)
      of_four.add((i * i + (i - 1) * (i - 1) + (i - 2) * (i - 2) + (i - 3) * (i - 3)) / 4.0);
  }
  CHECK(pyramid.pixels(0).count == 64);
  CHECK(pyramid.pixels(1).count == 16);
  CHECK(pyramid.pixels(1).variance() == Approx(of_four.variance()));
  CHECK(pyramid.pixels(3).count == 1);
  CHECK(pyramid.pixels(3).mean == Approx(63.0 * 127 / 6));
  CHECK(pyramid.pixels(4).count == 0);
}

TEST_CASE("the lamp lights a surface that faces it as much as the sky") {
  const Environment lamp = lamp_environment(0), sky = smooth_environment();
  double lit = 0;
  constexpr int kRings = 100000;  // a hundred on the lamp
  for (int i = 0; i < kRings; ++i) {
    const double z = (i + 0.5) / kRings;
    const Vec3<double> w{std::sqrt(1 - z * z), 0, z};
    lit += (lamp.radiance(w) - sky.radiance(w)) * z * 2 * std::numbers::pi / kRings;
  }
  CHECK(lit == Approx(std::numbers::pi).epsilon(2e-3));  // less 1 / sharpness for the cosine
  const auto aside = lamp_environment(60, 90).lamp;
  CHECK(aside.z == Approx(0.5));
  CHECK(aside.y == Approx(std::sqrt(0.75)));
}

TEST_CASE("all estimators of a surface have the mean that quadrature gives") {
  for (const double theta : {45.0, 80.0})
    for (const Alpha<double> alpha : {Alpha<double>{0.5, 0.5}, {0.3, 0.7}})
      for (const Environment& light : {smooth_environment(), lamp_environment()}) {
        const auto options = options_at(theta, alpha, light);
        const double smith = exact_radiance<SmithCorrelated>(options);
        const double cavities = exact_radiance<VCavityMasking>(options);
        for (const auto& r : run_variance_experiment(ggx_estimators(), options)) {
          const double exact = r.surface == "smith" ? smith : cavities;
          CAPTURE(theta, alpha.x, alpha.y, light.name, r.name, r.surface, r.samples().mean, exact);
          CHECK(r.samples().standard_error() < 0.04 * exact);  // so that the next line can fail
          CHECK(std::abs(r.samples().mean - exact) <
                kSameMean * r.samples().standard_error() + 2e-4 * exact);
          CHECK(std::abs(r.deviation) < kSameMean);
        }
      }
}

TEST_CASE("visible normals never weigh more than 1 and are better at grazing, for both surfaces") {
  for (const Environment& light : {smooth_environment(), lamp_environment()}) {
    const auto results =
        run_variance_experiment(ggx_estimators(), options_at(80, {0.5, 0.5}, light));
    for (const auto& r : results) {
      CAPTURE(light.name, r.name, r.surface, r.gain, r.tally.largest_weight, r.lost_fraction());
      CHECK(r.visible == !r.name.starts_with("algorithm-1"));
      if (r.visible) {
        CHECK(r.tally.largest_weight <= 1);
        CHECK(r.gain > 1.2);
        CHECK(r.lost_fraction() < find(results, "algorithm-1", r.surface).lost_fraction());
      } else {
        CHECK(r.tally.largest_weight > 1);
      }
    }
    for (const std::string surface : {"smith", "v-cavity"})
      CHECK(find(results, "algorithm-1", surface).gain == 1);
    CHECK(find(results, "algorithm-1").tally.largest_weight > 5);
    // Walter's trick lowers the weights, and what they vary.
    CHECK(find(results, "algorithm-1-walter").tally.largest_weight <
          find(results, "algorithm-1").tally.largest_weight);
    // At grazing incidence half of the normals face away.
    CHECK(find(results, "algorithm-1").lost_fraction() > 0.4);
    CHECK(find(results, "algorithm-1", "v-cavity").tally.largest_weight <= 2);
  }
}

TEST_CASE("tables sample with the variance of the closed form") {
  const auto results =
      run_variance_experiment(ggx_estimators(), options_at(80, {0.5, 0.5}, smooth_environment()));
  CHECK(find(results, "algorithm-2-analytic").gain_over_visible == 1);
  for (const std::string name : {"algorithm-2-exact", "algorithm-2-caps", "algorithm-2-tables"})
    CHECK(find(results, name).gain_over_visible == Approx(1).epsilon(0.01));
}

TEST_CASE("the spread of pixels falls with the square root of their samples") {
  const auto results = run_variance_experiment(
      ggx_estimators(), options_at(60, {0.5, 0.5}, smooth_environment(), 1 << 20));
  for (const auto& r : results)
    for (std::size_t k = 1; k < 5; ++k) {
      const auto& pixels = r.tally.pyramid.pixels(k);
      const double per_sample = pixels.variance() * std::pow(4, k);
      CAPTURE(r.name, r.surface, k);
      // The variance of n normal numbers has the relative error sqrt(2 / n).
      CHECK(per_sample ==
            Approx(r.samples().variance())
                .epsilon(kSameMean * std::sqrt(2.0 / static_cast<double>(pixels.count)) + 0.02));
    }
}

TEST_CASE("a biased estimator is noticed") {
  const auto options = options_at(60, {0.5, 0.5}, smooth_environment(), 1 << 19);
  const auto noticed = [&](Estimator sampler) {
    const auto right =
        sampler.surface == "smith"
            ? make_estimator<SmithCorrelated>("right", "smith", Ggx{})
            : make_estimator<VCavityMasking>("right", "v-cavity", ExactVCavity{AllGgx{Ggx{}}});
    return std::abs(run_variance_experiment({right, sampler}, options).back().deviation) >
           kSameMean;
  };
  CHECK_FALSE(noticed(make_estimator<SmithCorrelated>("right", "smith", Ggx{})));
  CHECK(noticed(make_estimator<SmithCorrelated>("rough", "smith", WrongRoughness<Ggx>{})));
  CHECK(noticed(make_estimator<SmithCorrelated>("lambda", "smith", WrongLambda{})));
  CHECK(noticed(make_estimator<SmithSeparable>("separable", "smith", Ggx{})));
  CHECK(noticed(make_estimator<VCavityMasking>("smith's normals", "v-cavity", Ggx{})));
}

TEST_CASE("results depend on the seed, not on the number of threads") {
  auto options = options_at(70, {0.3, 0.5}, lamp_environment());
  options.workers.threads = 1;
  const auto one = run_variance_experiment(ggx_estimators(), options);
  options.workers.threads = 3;
  const auto three = run_variance_experiment(ggx_estimators(), options);
  options.seed = 2;
  const auto other = run_variance_experiment(ggx_estimators(), options);
  for (std::size_t i = 0; i < one.size(); ++i) {
    CHECK(one[i].samples().mean == three[i].samples().mean);
    CHECK(one[i].samples().squares == three[i].samples().squares);
    CHECK(one[i].samples().mean != other[i].samples().mean);
  }
}

TEST_CASE("samples are rounded up to whole blocks") {
  const auto results =
      run_variance_experiment({make_estimator<SmithCorrelated>("caps", "smith", Ggx{})},
                              options_at(45, {0.5, 0.5}, smooth_environment(), kBlockSamples + 1));
  CHECK(results[0].samples().count == 2 * kBlockSamples);
  CHECK(results[0].deviation == 0);
}

TEST_CASE("the horizon itself is a finite pixel") {
  for (const auto& r : run_variance_experiment(
           ggx_estimators(), options_at(90, {0.5, 0.5}, smooth_environment(), kBlockSamples))) {
    CAPTURE(r.name, r.surface);
    CHECK(std::isfinite(r.samples().mean));
    CHECK(std::isfinite(r.tally.largest_weight));
    CHECK(r.samples().mean > 0);
  }
}

TEST_CASE("options outside their range are refused by name") {
  const auto refused = [](auto change) {
    VarianceOptions options;
    change(options);
    try {
      run_variance_experiment({}, options);
    } catch (const std::invalid_argument& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  CHECK_THAT(refused([](auto& o) { o.theta = 91; }), contains("theta"));
  CHECK_THAT(refused([](auto& o) { o.azimuth = std::nan(""); }), contains("azimuth"));
  CHECK_THAT(refused([](auto& o) { o.alpha.y = 0; }), contains("alpha"));
  CHECK_THAT(refused([](auto& o) { o.metal.k = -1; }), contains("metal"));
  CHECK_THAT(refused([](auto& o) { o.samples = 0; }), contains("samples"));
  CHECK(refused([](auto&) {}).empty());
}

TEST_CASE("tables and the closed form have one mean and one variance to 1e8 samples", "[.slow]") {
  const auto estimators = named_estimators(large_tables("ggx").tables);
  for (const double theta : {45.0, 80.0}) {
    const auto results = run_variance_experiment(
        estimators, options_at(theta, {0.5, 0.5}, smooth_environment(), 100'000'000));
    for (const auto& r : results) {
      CAPTURE(theta, r.name, r.samples().mean, r.samples().standard_error(), r.gain, r.deviation);
      CHECK(std::abs(r.deviation) < kSameMean);
      if (r.visible && r.surface == "smith") CHECK(r.samples().standard_error() < 1e-4);
    }
    const double variance = find(results, "algorithm-2-exact").samples().variance();
    for (const std::string name : {"algorithm-2-caps", "algorithm-2-tables"})
      CHECK(find(results, name).samples().variance() == Approx(variance).epsilon(1e-3));
  }
}
