// The list of named distributions. Programs show it to people, and parse_distribution.h reads names
// and parameters by it.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "vndf/distributions/slope_distribution.h"

namespace vndf::distributions {

/// Largest u-error of either table of 1024 x 1024, over the ranges of all parameters.
inline constexpr double kRangeUError = 2e-4;

/// A number that a family of distributions takes.
struct FamilyParameter {
  std::string name;
  double default_value;
  /// From the least to the greatest value the tables keep kRangeUError. Beyond, they err by more,
  /// or slopes leave the range of their numbers.
  double least, greatest;

  /// "1.55 to 100".
  std::string range() const;
};

struct FamilyInfo {
  std::string name;        ///< as in specifications
  std::string parameters;  ///< with default and range, "gamma=2.5 (1.55 to 1e+06)"; empty for none
  std::string density;     ///< p22(r) at unit roughness
  std::string source;      ///< where it comes from
  std::vector<FamilyParameter> accepts;
  /// Makes the distribution from a value in the range of each of `accepts`, in that order. It is
  /// empty for mixtures, which are made of other families.
  std::function<std::unique_ptr<SlopeDistribution>(const std::vector<double>&)> make;
};

/// Returns all families, in the order in which to show them.
const std::vector<FamilyInfo>& families();

}  // namespace vndf::distributions
