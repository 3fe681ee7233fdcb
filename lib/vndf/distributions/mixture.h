// Mixtures of slope distributions, each component with a roughness of its own (for example the two
// GGX lobes that renderers blend as haze).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "vndf/distributions/slope_distribution.h"

namespace vndf::distributions {

/// sum w_i p22_i(r / a_i) / a_i^2 of normalised distributions. Its visible normals are no fixed
/// mixture of theirs: the weights change with the incident direction.
class Mixture final : public SlopeDistribution {
 public:
  struct Component {
    double weight;  ///< > 0; the constructor divides by their sum
    std::shared_ptr<const SlopeDistribution> distribution;  ///< of mass 1, as all above are
    double roughness = 1;                                   ///< a_i > 0
  };

  /// Throws std::invalid_argument for no components, no distribution, or a weight or roughness that
  /// is not finite and > 0. An empty `name` stands for "mixture:0.7*ggx+0.3*beckmann@0.2", with the
  /// weights as given.
  explicit Mixture(std::vector<Component> components, const std::string& name = {});

  std::string name() const override { return name_; }
  double p22(double r) const override;
  bool costly() const override;
  std::vector<double> breaks() const override;
  double support() const override;
  /// Where every component has them.
  std::optional<Marginals> marginals(double x) const override;

 private:
  std::vector<Component> components_;
  std::string name_;
};

}  // namespace vndf::distributions
