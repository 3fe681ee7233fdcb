// Mixtures of slope distributions. Each component has a roughness of its own, as the two GGX lobes
// do that renderers blend as haze.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "vndf/distributions/slope_distribution.h"

namespace vndf::distributions {

/// The density sum w_i p22_i(r / a_i) / a_i^2 of normalised distributions. Visible normals of a
/// mixture are not a fixed mixture of those of its components, because their weights change with
/// the incident direction. A mixture therefore needs tables of its own.
class Mixture final : public SlopeDistribution {
 public:
  struct Component {
    double weight;  ///< > 0; the constructor divides by their sum
    std::shared_ptr<const SlopeDistribution> distribution;  ///< of mass 1, as all above are
    double roughness = 1;                                   ///< a_i > 0
  };

  /// Throws std::invalid_argument if there are no components, if one has no distribution, or if a
  /// weight or roughness is not finite and > 0. Without a `name` the mixture is called as
  /// parse_distribution() reads it, for example "mixture:0.7*ggx+0.3*beckmann@0.2", with the
  /// weights as given.
  explicit Mixture(std::vector<Component> components, const std::string& name = {});

  std::string name() const override { return name_; }
  double p22(double r) const override;
  bool costly() const override;
  std::vector<double> breaks() const override;
  double support() const override;
  /// They are known where every component knows its own.
  std::optional<Marginals> marginals(double x) const override;

 private:
  std::vector<Component> components_;
  std::string name_;
};

}  // namespace vndf::distributions
