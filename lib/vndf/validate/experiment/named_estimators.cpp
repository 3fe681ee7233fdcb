// The ways of sampling a rough metal that the variance experiment compares, by name.
#include "vndf/validate/experiment/named_estimators.h"

#include "vndf/bsdf/all_normals.h"
#include "vndf/bsdf/masking.h"
#include "vndf/reference/beckmann_analytic.h"
#include "vndf/reference/beckmann_exact.h"
#include "vndf/reference/ggx_analytic.h"
#include "vndf/reference/ggx_caps.h"
#include "vndf/reference/ggx_exact.h"
#include "vndf/reference/v_cavity.h"
#include "vndf/reference/walter_roughness.h"
#include "vndf/tabulated_sampler.h"

namespace vndf::validate {
namespace {

/// Algorithm 2 by the closed forms that the distribution has.
void add_analytic(std::vector<Estimator>& list, const std::string& distribution) {
  const auto add = [&](const char* name, auto sampler) {
    list.push_back(make_estimator<SmithCorrelated>(name, "smith", sampler));
  };
  if (distribution == "beckmann") {
    add("algorithm-2-analytic", BeckmannAnalytic<double>{});
    add("algorithm-2-exact", BeckmannExact<double>{});
  }
  if (distribution == "ggx") {
    add("algorithm-2-analytic", GgxAnalytic<double>{});
    add("algorithm-2-exact", GgxExact<double>{});
    add("algorithm-2-caps", GgxCaps<double>{});
  }
}

}  // namespace

std::vector<Estimator> named_estimators(const std::shared_ptr<const SlopeTables>& tables) {
  const TabulatedSampler<double> visible(tables);
  const AllNormals<TabulatedSampler<double>> all(visible);
  const WalterRoughness<AllNormals<TabulatedSampler<double>>> walter(all);
  const VCavity<AllNormals<TabulatedSampler<double>>> cavities(all);
  std::vector<Estimator> list{
      make_estimator<SmithCorrelated>("algorithm-1", "smith", all),
      make_estimator<SmithCorrelated>("algorithm-1-walter", "smith", walter),
  };
  // Before the tables: the first of visible normals is what the others are compared with.
  add_analytic(list, tables->distribution);
  list.push_back(make_estimator<SmithCorrelated>("algorithm-2-tables", "smith", visible));
  list.push_back(make_estimator<VCavityMasking>("algorithm-1", "v-cavity", all));
  list.push_back(make_estimator<VCavityMasking>("algorithm-1-walter", "v-cavity", walter));
  list.push_back(make_estimator<VCavityMasking>("algorithm-3", "v-cavity", cavities));
  return list;
}

}  // namespace vndf::validate
