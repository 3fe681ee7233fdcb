// The list of named distributions. Programs show it to people, and parse_distribution.h reads names
// and parameters by it.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "vndf/distributions/slope_distribution.h"

namespace vndf::distributions {

/// A number that a family of distributions takes.
struct FamilyParameter {
  std::string name;
  double default_value;
  std::string range;  ///< "> 3/2"
};

struct FamilyInfo {
  std::string name;        ///< as in specifications
  std::string parameters;  ///< with default and range, "gamma=2.5 (> 3/2)"; empty for none
  std::string density;     ///< p22(r) at unit roughness
  std::string source;      ///< where it comes from
  std::vector<FamilyParameter> accepts;
  /// Makes the distribution from a value of each of `accepts`, in that order. Throws
  /// std::invalid_argument for a value out of its range. It is empty for mixtures, which are made
  /// of other families.
  std::function<std::unique_ptr<SlopeDistribution>(const std::vector<double>&)> make;
};

/// Returns all families, in the order in which to show them.
const std::vector<FamilyInfo>& families();

}  // namespace vndf::distributions
