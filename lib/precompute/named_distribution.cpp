// The slope distributions that come with the toolkit, by name.
#include "precompute/named_distribution.h"

#include <cmath>
#include <numbers>

namespace vndf::precompute {

double Beckmann::p22(double r) const {
  return std::exp(-r * r) * std::numbers::inv_pi;
}

double Ggx::p22(double r) const {
  const double square = 1 + r * r;
  return std::numbers::inv_pi / (square * square);
}

std::vector<std::string> distribution_names() {
  return {"beckmann", "ggx"};
}

std::unique_ptr<SlopeDistribution> named_distribution(const std::string& name) {
  if (name == "beckmann") return std::make_unique<Beckmann>();
  if (name == "ggx") return std::make_unique<Ggx>();
  std::string known;
  for (const auto& n : distribution_names()) known += (known.empty() ? "" : ", ") + n;
  throw std::invalid_argument("no distribution is called '" + name + "'; choose one of: " + known);
}

}  // namespace vndf::precompute
