// Materials by surface and sampling: they are the library's BSDFs, and every way of sampling agrees
// with its density.
#include "render/surface.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "render/metals.h"
#include "render/sample_sequence.h"
#include "support/baked_tables.h"
#include "support/catch.h"
#include "vndf/bsdf/conductor_brdf.h"
#include "vndf/reference/ggx_caps.h"

using namespace vndf;
using namespace vndf::render;
using namespace vndf::test;

namespace {

constexpr Sampling kAll[]{Sampling::previous, Sampling::walter, Sampling::visible};
const Vector kIncident = normalize_or_up(Vector{0.5f, 0.3f, 0.6f});
constexpr Alpha<float> kAlpha{0.3f, 0.5f};

/// The mean weight of many samples and its standard error: the reflected share of light.
struct Mean {
  double value, error;
};

Mean mean_weight(const Material& material) {
  constexpr std::uint32_t kSamples = 1 << 16;
  double sum = 0, squares = 0;
  for (std::uint32_t i = 0; i < kSamples; ++i) {
    SampleSequence numbers(5, i, 0);
    const auto u = numbers.next_pair();
    const auto weight = static_cast<double>(material.sample(kIncident, u, numbers.next()).weight.g);
    sum += weight;
    squares += weight * weight;
  }
  const double mean = sum / kSamples;
  return {mean, std::sqrt((squares / kSamples - mean * mean) / kSamples)};
}

std::shared_ptr<const KernelTables> shared_tables() {
  return std::make_shared<const KernelTables>(baked_tables("ggx"));
}

}  // namespace

TEST_CASE("a metal is the BRDF of the library", "[render]") {
  const auto material =
      analytic_surface("ggx-caps", Sampling::visible)->metal(kAlpha, kMetals[1].fresnel);
  const GgxCaps<float> caps;
  const ConductorBrdf brdf(caps, kAlpha, kMetals[1].fresnel);
  const Vector wo = normalize_or_up(Vector{-0.2f, -0.5f, 0.7f});
  CHECK(material->evaluate(kIncident, wo).b == brdf.evaluate(kIncident, wo)[2]);
  CHECK(material->pdf(kIncident, wo) == brdf.pdf(kIncident, wo));
  CHECK(material->sample(kIncident, {0.2f, 0.6f}, 0).weight.r ==
        brdf.sample(kIncident, 0.2f, 0.6f).weight[0]);
}

TEST_CASE("all ways of sampling reflect the same share of light", "[render]") {
  for (const bool metal : {true, false}) {
    const auto made = [&](const Surface& s) {
      return metal ? s.metal(kAlpha, kMetals[0].fresnel) : s.glass(kAlpha, 1.5f);
    };
    const Mean exact = mean_weight(*made(*analytic_surface("ggx-exact", Sampling::visible)));
    for (const Sampling sampling : kAll) {
      for (const auto& surface :
           {analytic_surface("ggx-caps", sampling), tabulated_surface(shared_tables(), sampling),
            tabulated_surface(small_tables("ggx").tables, sampling)}) {
        const Mean mean = mean_weight(*made(*surface));
        CAPTURE(metal, static_cast<int>(sampling), mean.value, exact.value);
        CHECK(std::abs(mean.value - exact.value) < 4.9 * std::hypot(mean.error, exact.error));
      }
    }
  }
}

TEST_CASE("only visible normals keep weights below 1, and Walter's trick lowers the largest",
          "[render]") {
  const Vector grazing = normalize_or_up(Vector{1, 0, 0.05f});
  const auto largest = [&](const std::string& name, Sampling sampling) {
    const auto material = analytic_surface(name, sampling)->glass({0.3f, 0.3f}, 1.5f);
    float weight = 0;
    for (std::uint32_t i = 0; i < 1 << 14; ++i) {
      SampleSequence numbers(7, i, 0);
      const auto u = numbers.next_pair();
      weight = std::max(weight, material->sample(grazing, u, numbers.next()).weight.g);
    }
    return weight;
  };
  CHECK(largest("beckmann-exact", Sampling::visible) <= 1);
  CHECK(largest("beckmann-v-cavity", Sampling::visible) <= 1);
  const float walter = largest("beckmann-exact", Sampling::walter);
  CHECK(walter > 1);
  CHECK(largest("beckmann-exact", Sampling::previous) > 1.2f * walter);
  // With V-cavities the weights of all normals are at most 2 (section 2.2 of the paper).
  CHECK(largest("beckmann-v-cavity", Sampling::previous) > 1);
  CHECK(largest("beckmann-v-cavity", Sampling::previous) <= 2.0001f);
}

TEST_CASE("a sample's weight is the BSDF over the density, for every name and sampling",
          "[render]") {
  for (const std::string& name : analytic_surfaces())
    for (const Sampling sampling : kAll) {
      const auto surface = analytic_surface(name, sampling);
      for (const auto& material :
           {surface->metal(kAlpha, kMetals[2].fresnel), surface->glass(kAlpha, 1.5f)})
        for (int i = 0; i < 20; ++i) {
          const float t = static_cast<float>(i) / 20;
          const Scattered drawn = material->sample(kIncident, {t, 1 - t}, 0.37f);
          if (!(drawn.pdf > 0)) continue;
          CAPTURE(name, static_cast<int>(sampling), i);
          // Float: half vectors of the sampled direction are exact to a few 1e-5 relative.
          CHECK(drawn.weight.g * drawn.pdf ==
                Approx(material->evaluate(kIncident, drawn.wo).g).epsilon(1e-2));
          CHECK(drawn.pdf == Approx(material->pdf(kIncident, drawn.wo)).epsilon(1e-2));
        }
    }
}

TEST_CASE("a matt surface reflects its albedo, and nothing from below", "[render]") {
  const Matt matt({0.2f, 0.4f, 0.6f});
  const Mean mean = mean_weight(matt);
  CHECK(mean.value == Approx(0.4));
  const Scattered drawn = matt.sample(kIncident, {0.3f, 0.8f}, 0);
  CHECK(drawn.pdf == Approx(drawn.wo.z / std::numbers::pi_v<float>));
  CHECK(matt.evaluate(kIncident, drawn.wo).r == Approx(0.2f * drawn.pdf));
  CHECK(matt.pdf(kIncident, {0, 0, -1}) == 0);
  CHECK(matt.sample({0, 0, -1}, {0.3f, 0.8f}, 0).pdf == 0);
}

TEST_CASE("an unknown surface is named with the nearest known one", "[render]") {
  CHECK_THROWS_WITH(analytic_surface("ggx-cap", Sampling::visible),
                    contains("did you mean 'ggx-caps'?"));
}
