// The ways of sampling a rough metal that the variance experiment compares, by name.
#include "validate/named_estimators.h"

#include "vndf/all_normals.h"
#include "vndf/masking.h"
#include "vndf/tabulated_sampler.h"

namespace vndf::validate {

std::vector<Estimator> named_estimators(const std::shared_ptr<const SlopeTables>& tables) {
  const TabulatedSampler<double> visible(tables);
  const AllNormals<double, TabulatedSampler<double>> all(visible);
  return {
      make_estimator<SmithCorrelated>("algorithm-1", "smith", all),
      make_estimator<SmithCorrelated>("algorithm-2-tables", "smith", visible),
      make_estimator<VCavityMasking>("algorithm-1", "v-cavity", all),
  };
}

}  // namespace vndf::validate
