// The list of named distributions, for people (vndf build --list) and for the parser of
// specifications (distribution_spec.h).
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "vndf/distributions/slope_distribution.h"

namespace vndf::distributions {

/// A number that a family takes.
struct FamilyParameter {
  std::string name;
  double default_value;
  std::string range;  ///< "> 3/2"
};

struct FamilyInfo {
  std::string name;        ///< as specifications write it
  std::string parameters;  ///< with default and range, "gamma=2.5 (> 3/2)"; empty for none
  std::string density;     ///< p22(r) at unit roughness
  std::string source;      ///< where it comes from
  std::vector<FamilyParameter> accepts;
  /// The distribution for a value of each of `accepts`, in that order. Throws std::invalid_argument
  /// for one out of range. Empty for mixtures, which are made of other families.
  std::function<std::unique_ptr<SlopeDistribution>(const std::vector<double>&)> make;
};

/// All of them, in the order to show.
const std::vector<FamilyInfo>& families();

}  // namespace vndf::distributions
