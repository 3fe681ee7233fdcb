// The slope distributions that come with the toolkit, by name.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "precompute/slope_distribution.h"

namespace vndf::precompute {

/// Beckmann: Gaussian slopes, p22(r) = exp(-r^2) / pi.
class Beckmann final : public SlopeDistribution {
 public:
  std::string name() const override { return "beckmann"; }
  double p22(double r) const override;
};

/// GGX (Trowbridge-Reitz): p22(r) = 1 / (pi (1 + r^2)^2).
class Ggx final : public SlopeDistribution {
 public:
  std::string name() const override { return "ggx"; }
  double p22(double r) const override;
};

/// Names that named_distribution() accepts.
std::vector<std::string> distribution_names();

/// The distribution called `name`. Throws std::invalid_argument, listing the names, for another.
std::unique_ptr<SlopeDistribution> named_distribution(const std::string& name);

}  // namespace vndf::precompute
