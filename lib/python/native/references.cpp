// The samplers of the papers, by the names that the program lists. Those of a surface whose own
// alpha does more than stretch are taken as they are, and not frozen at one alpha as for the
// validator.
#include <map>
#include <string>
#include <vector>

#include <pybind11/stl.h>

#include "module.h"
#include "normals.h"
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
#include "vndf/validate/sampler/named_samplers.h"

namespace vndf::python {

namespace py = pybind11;

namespace {

template <class S, class D>
Sampler sampler_of(Model model, const S& in_single, const D& in_double) {
  Sampler sampler;
  sampler.model = model;
  sampler.in_single = std::make_shared<NormalsOf<S>>(in_single);
  sampler.in_double = std::make_shared<NormalsOf<D>>(in_double);
  return sampler;
}

template <template <class> class S>
Sampler sampler_of(Model model) {
  return sampler_of(model, S<float>{}, S<double>{});
}

template <class T>
using GgxCavity = VCavity<GgxNdf<T>>;
template <class T>
using BeckmannCavity = VCavity<BeckmannNdf<T>>;
template <class T>
using GgxWalter = WalterRoughness<GgxNdf<T>>;
template <class T>
using BeckmannWalter = WalterRoughness<BeckmannNdf<T>>;

Sampler gtr(double gamma) {
  const GtrProfile profile(gamma);
  return sampler_of(Model::all, GeneralisedTrowbridgeReitzNdf<float>(profile),
                    GeneralisedTrowbridgeReitzNdf<double>(profile));
}

std::map<std::string, Sampler> all_references() {
  constexpr auto kVisible = Model::visible_smith, kAll = Model::all,
                 kCavity = Model::visible_v_cavity;
  return {
      {"beckmann-analytic", sampler_of<BeckmannAnalytic>(kVisible)},
      {"beckmann-exact", sampler_of<BeckmannExact>(kVisible)},
      {"ggx-analytic", sampler_of<GgxAnalytic>(kVisible)},
      {"ggx-exact", sampler_of<GgxExact>(kVisible)},
      {"ggx-hemisphere", sampler_of<GgxHemisphere>(kVisible)},
      {"ggx-caps", sampler_of<GgxCaps>(kVisible)},
      {"beckmann-ndf", sampler_of<BeckmannNdf>(kAll)},
      {"ggx-ndf", sampler_of<GgxNdf>(kAll)},
      {"beckmann-walter", sampler_of<BeckmannWalter>(kAll)},
      {"ggx-walter", sampler_of<GgxWalter>(kAll)},
      {"blinn-phong-ndf", sampler_of<BlinnPhongNdf>(kAll)},
      {"gtr-1.5-ndf", gtr(1.5)},
      {"gtr-2-ndf", gtr(2)},
      {"beckmann-v-cavity", sampler_of<BeckmannCavity>(kCavity)},
      {"ggx-v-cavity", sampler_of<GgxCavity>(kCavity)},
  };
}

/// The names that the program lists, each with the distribution that the sampler claims.
std::vector<std::pair<std::string, std::string>> named_references() {
  std::vector<std::pair<std::string, std::string>> names;
  for (const auto& sampler : validate::named_samplers())
    names.emplace_back(sampler.name, sampler.distribution);
  return names;
}

}  // namespace

void add_references(py::module_& module) {
  module.def("references", all_references);
  module.def("named_references", named_references);
}

}  // namespace vndf::python
