// The reference samplers that can be validated by name.
#include "vndf/validate/sampler/named_samplers.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "vndf/distributions/formula_distribution.h"
#include "vndf/distributions/parse_distribution.h"
#include "vndf/reference/beckmann_analytic.h"
#include "vndf/reference/beckmann_exact.h"
#include "vndf/reference/beckmann_ndf.h"
#include "vndf/reference/blinn_phong_ndf.h"
#include "vndf/reference/generalised_trowbridge_reitz_ndf.h"
#include "vndf/reference/ggx_analytic.h"
#include "vndf/reference/ggx_caps.h"
#include "vndf/reference/ggx_exact.h"
#include "vndf/reference/ggx_hemisphere.h"
#include "vndf/reference/ggx_ndf.h"
#include "vndf/reference/v_cavity.h"
#include "vndf/reference/walter_roughness.h"
#include "vndf/support/text.h"
#include "vndf/validate/sampler/frozen_surface.h"
#include "vndf/validate/sampler/widened_surface.h"

namespace vndf::validate {
namespace {

/// The roughness at which samplers are frozen whose alpha does more than stretch.
constexpr double kFrozenAlpha = 0.5;

/// An entry of the list, where `in_single` and `in_double` are one sampler in both precisions.
template <NormalSampler<float> S, NormalSampler<double> D>
NamedSampler entry(std::string name, const std::string& distribution, const Claims& claims,
                   const S& in_single, const D& in_double) {
  return {std::move(name), distribution,
          [distribution] { return distributions::parse_distribution(distribution); },
          [=](std::string label, std::shared_ptr<const ExactSlopes> exact) {
            return under_test(std::move(label), std::move(exact), in_single, in_double, claims);
          }};
}

/// `Sampler<T>`, made without arguments.
template <template <class> class Sampler>
NamedSampler reference(std::string name, const std::string& distribution, const Claims& claims) {
  return entry(std::move(name), distribution, claims, Sampler<float>{}, Sampler<double>{});
}

/// The surface of roughness kFrozenAlpha of `in_single` and `in_double`.
template <class S, class D>
NamedSampler frozen(std::string name, const std::string& distribution, const S& in_single,
                    const D& in_double) {
  return entry(std::move(name), distribution, {.normals = SampledNormals::all},
               FrozenSurface<float, S>(in_single, static_cast<float>(kFrozenAlpha)),
               FrozenSurface<double, D>(in_double, kFrozenAlpha));
}

template <class T>
using GgxCavity = VCavity<GgxNdf<T>>;
template <class T>
using BeckmannCavity = VCavity<BeckmannNdf<T>>;
template <class T>
using GgxWalter = WidenedSurface<T, WalterRoughness<GgxNdf<T>>>;
template <class T>
using BeckmannWalter = WidenedSurface<T, WalterRoughness<BeckmannNdf<T>>>;
template <class T>
using Gtr = GeneralisedTrowbridgeReitzNdf<T>;

NamedSampler gtr_1_5() {
  constexpr const char* kNdf = "(1 + (alpha^2 - 1) * cos(theta)^2)^(-1.5)";
  const GtrProfile profile(1.5);
  auto sampler = frozen("gtr-1.5-ndf", "D = " + std::string(kNdf) + ", alpha = 0.5",
                        Gtr<float>(profile), Gtr<double>(profile));
  sampler.make_distribution = [] {
    return std::make_unique<distributions::FormulaDistribution>(
        distributions::FormulaDistribution::from_ndf(distributions::NdfFormula({kNdf, {}}),
                                                     kFrozenAlpha));
  };
  return sampler;
}

std::vector<NamedSampler> all_samplers() {
  const Claims map{.monotone_inverse = true}, visible{}, all{.normals = SampledNormals::all},
      cavities{.normals = SampledNormals::visible_v_cavity, .smooth = false};
  // Within a cone around normal incidence the sampler takes polar coordinates.
  const Claims map_outside_cone{
      .monotone_inverse = true,
      .inverse_from = std::acos(GgxAnalyticMethod::kNormalIncidence) / kDegree};
  return {
      reference<BeckmannAnalytic>("beckmann-analytic", "beckmann", visible),
      reference<BeckmannExact>("beckmann-exact", "beckmann", map),
      reference<GgxAnalytic>("ggx-analytic", "ggx", map_outside_cone),
      reference<GgxExact>("ggx-exact", "ggx", map),
      reference<GgxHemisphere>("ggx-hemisphere", "ggx", visible),
      reference<GgxCaps>("ggx-caps", "ggx", visible),
      reference<BeckmannNdf>("beckmann-ndf", "beckmann", all),
      reference<GgxNdf>("ggx-ndf", "ggx", all),
      reference<BeckmannWalter>("beckmann-walter", "beckmann", all),
      reference<GgxWalter>("ggx-walter", "ggx", all),
      // n + 2 = 2 / alpha^2
      frozen("blinn-phong-ndf", "blinn-phong:n=6", BlinnPhongNdf<float>{}, BlinnPhongNdf<double>{}),
      gtr_1_5(),
      // With this gamma alpha only stretches.
      entry("gtr-2-ndf", "ggx", all, Gtr<float>(GtrProfile(2)), Gtr<double>(GtrProfile(2))),
      reference<BeckmannCavity>("beckmann-v-cavity", "beckmann", cavities),
      reference<GgxCavity>("ggx-v-cavity", "ggx", cavities),
  };
}

}  // namespace

const std::vector<NamedSampler>& named_samplers() {
  static const std::vector<NamedSampler> list = all_samplers();
  return list;
}

const NamedSampler& find_sampler(const std::string& name) {
  const auto& list = named_samplers();
  const auto found =
      std::find_if(list.begin(), list.end(), [&](const NamedSampler& s) { return s.name == name; });
  if (found != list.end()) return *found;
  std::vector<std::string> known;
  for (const NamedSampler& s : list) known.push_back(s.name);
  throw std::invalid_argument("'" + name + "' is neither a table file nor a reference sampler" +
                              support::did_you_mean(name, known) +
                              "; known: " + support::listed(known));
}

}  // namespace vndf::validate
