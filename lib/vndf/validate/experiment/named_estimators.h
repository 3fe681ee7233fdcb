// The ways of sampling a rough metal that the variance experiment compares, by name.
#pragma once

#include <memory>
#include <vector>

#include "vndf/slope_tables.h"
#include "vndf/validate/experiment/variance_experiment.h"

namespace vndf::validate {

/// The estimators for the distribution of `tables`, which must not be null: Smith's surface with
/// correlated heights and V-cavities, each first by Algorithm 1.
std::vector<Estimator> named_estimators(const std::shared_ptr<const SlopeTables>& tables);

}  // namespace vndf::validate
