// The means of the pictures of sample weights are compared with the reflectance by quadrature over
// normals, and their largest weights with the bounds of Heitz and d'Eon 2014, Table 2.
#include "vndf/validate/pictures/sample_weights.h"

#include <cmath>

#include "support/catch.h"
#include "support/samplers_under_test.h"
#include "vndf/bsdf/scatter.h"
#include "vndf/validate/exact/normal_quadrature.h"
#include "vndf/validate/sampler/named_samplers.h"

using namespace vndf;
using namespace vndf::validate;
using namespace vndf::test;

namespace {

const Configuration kGrazing = at_angles(1.5 / kDegree, 0, 0.5, 0.5);
constexpr std::size_t kCells = 160;
constexpr double kRounding = 1e-6;  // of single precision

/// Means over one point in each cell: weights jump along lines, and the previous method's rise to
/// tens in a corner.
constexpr double kMeanError = 2e-3, kPreviousMeanError = 1e-2;

SamplerUnderTest sampler_called(const std::string& name) {
  const auto& named = find_sampler(name);
  return named.make(named.name, std::make_shared<ExactSlopes>(named.make_distribution()));
}

/// Reflectance of Smith's surface: the mean of G2 / G1 = (1 + Li) / (1 + Li + Lo) over the exact
/// density of visible normals.
double smith_reflectance(const ExactSlopes& slopes, const Configuration& c) {
  const ExactDistribution exact(slopes, SampledNormals::visible_smith, c);
  const auto nodes = normal_quadrature(slopes, SampledNormals::visible_smith, c);
  const double li = slopes.lambda(c.wi, c.alpha);
  double sum = 0;
  for (std::size_t k = 0; k < nodes.wm.size(); ++k) {
    const Vec3<double> wo = reflect(c.wi, nodes.wm[k]);
    if (!(wo.z > 0)) continue;
    const double shadowed = (1 + li) / (1 + li + slopes.lambda(wo, c.alpha));
    sum += exact.pdf(nodes.wm[k]) * nodes.weight[k] * shadowed;
  }
  return sum;
}

}  // namespace

TEST_CASE("weights of both methods have the reflectance of the surface as their mean") {
  for (const char* name : {"ggx-caps", "beckmann-exact"}) {
    const SamplerUnderTest s = sampler_called(name);
    const double reflectance = smith_reflectance(*s.exact, kGrazing);
    CAPTURE(name, reflectance);
    CHECK(sample_weights(s, kGrazing, kCells).mean == Approx(reflectance).margin(kMeanError));
    CHECK(previous_weights(s, kGrazing, kCells).mean ==
          Approx(reflectance).margin(kPreviousMeanError));
  }
}

TEST_CASE("weights of visible normals are at most 1, and few are lost") {
  for (const char* name : {"ggx-caps", "beckmann-exact", "ggx-v-cavity"}) {
    const SampleWeights w = sample_weights(sampler_called(name), kGrazing, kCells);
    CAPTURE(name);
    CHECK(w.largest <= 1 + kRounding);
    CHECK(w.largest == largest(w.weight));
    CHECK(w.lost < 0.05);
  }
}

TEST_CASE("half of all normals are lost at grazing, and the others have large weights") {
  const SampleWeights smith = previous_weights(sampler_called("ggx-caps"), kGrazing, kCells);
  CHECK(smith.largest > 10);
  CHECK(smith.lost == Approx(0.5).margin(0.05));
  // of V-cavities no larger than 2
  const SampleWeights cavities = previous_weights(sampler_called("ggx-v-cavity"), kGrazing, kCells);
  CHECK(cavities.largest <= 2 + 2 * kRounding);
  CHECK(cavities.largest > 1.9);
}

TEST_CASE("a sampler of all normals is the previous method") {
  const SamplerUnderTest ndf = sampler_called("ggx-ndf");
  const SampleWeights own = sample_weights(ndf, kGrazing, 40);
  const SampleWeights previous = previous_weights(ndf, kGrazing, 40);
  for (std::size_t k = 0; k < own.weight.values.size(); ++k)
    CHECK(own.weight.values[k] == Approx(previous.weight.values[k]).epsilon(1e-5));
}
