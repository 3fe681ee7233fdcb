// The reference samplers that can be checked by name. A new sampler is one line of the list.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "vndf/distributions/slope_distribution.h"
#include "vndf/validate/sampler/sampler_under_test.h"

namespace vndf::validate {

struct NamedSampler {
  std::string name;
  /// The distribution that it claims, in words, and as a distribution.
  std::string distribution;
  std::function<std::unique_ptr<distributions::SlopeDistribution>()> make_distribution;
  /// Of that distribution, which may be shared.
  std::function<SamplerUnderTest(std::string name, std::shared_ptr<const ExactSlopes> exact)> make;
};

/// All of them, in the order to show.
const std::vector<NamedSampler>& named_samplers();

/// The one called `name`. Throws std::invalid_argument, naming the nearest known one.
const NamedSampler& find_sampler(const std::string& name);

}  // namespace vndf::validate
